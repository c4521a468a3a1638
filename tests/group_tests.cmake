# Write a source file of several tests, which are compiled as one: most of the time
# goes into the headers that they share. Called by ninja:
#   cmake -DGROUP=group.cc "-DTESTS=/path/of/a.cc;/path/of/b.cc" -P group_tests.cmake
# Each test stands in a namespace of its own, so that names are its own, too; what it
# includes is included before.
cmake_policy(VERSION 3.18)
set(includes "")
set(bodies "")
set(cases "")
foreach(test ${TESTS})
  get_filename_component(name ${test} NAME_WE)
  file(STRINGS ${test} lines REGEX "^#include ")
  list(APPEND includes ${lines})
  string(APPEND bodies "namespace test_${name}\n{\n#include \"${test}\"\n}\n")
  string(APPEND cases "  if (name == \"${name}\")\n"
    "    return run(test_${name}::main, argc - 1, argv + 1);\n")
endforeach()
list(REMOVE_DUPLICATES includes)
list(JOIN includes "\n" includes)
file(WRITE ${GROUP} "${includes}
#include <string>
${bodies}
static int
run(int (*test)(int, char **), int argc, char **argv)
{
  return test(argc, argv);
}

[[maybe_unused]] static int
run(int (*test)(), int, char **)
{
  return test();
}

int
main(int argc, char **argv)
{
  const std::string name = argc > 1 ? argv[1] : \"\";
${cases}  return 1;
}
")
