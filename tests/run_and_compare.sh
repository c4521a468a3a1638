#!/bin/sh
# Run a test as deal.II's test suite does, in the present directory:
#   run_and_compare.sh NUMDIFF EXPECTED PROGRAM [ARGUMENT ...]
# What it prints is left in output, the differences from EXPECTED in diff.
numdiff=$1 expected=$2
shift 2
# there may be more ranks than cores, with one thread each
export OMPI_MCA_rmaps_base_oversubscribe=1 OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
rm -f stdout output diff
"$@" >stdout 2>&1
code=$?
mv stdout output
if [ $code -ne 0 ]; then
  cat output
  echo "exit code $code"
  exit 1
fi
if ! "$numdiff" -a 1e-6 -r 1e-8 -s ' \t\r\n=,:;<>[](){}^' "$expected" output >diff; then
  echo "$PWD/output differs from $expected:"
  head -n 20 diff
  exit 1
fi
