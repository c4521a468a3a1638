/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_plain_message_h
#define isochor_plain_message_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <sstream>
#include <string>

namespace isochor
{
  using namespace dealii;

  /** @p number with four digits, for messages. */
  inline std::string
  rounded(const double number)
  {
    std::ostringstream text;
    text.precision(4);
    text << number;
    return text.str();
  }

  /** What an exception has to say to users: of those of deal.II the message
   * alone, without the place in the sources. */
  inline std::string
  plain_message(const std::exception &exception)
  {
    const auto *of_deal_ii = dynamic_cast<const ExceptionBase *>(&exception);
    if (of_deal_ii == nullptr)
      return exception.what();
    std::ostringstream text;
    of_deal_ii->print_info(text);
    return Utilities::trim(text.str());
  }

  /** The same for errors that end a run: ExcMessage is written for the user.
   * Other exceptions of deal.II are likely defects, of which the place in the
   * sources matters too. */
  inline std::string
  error_message(const std::exception &exception)
  {
    return dynamic_cast<const StandardExceptions::ExcMessage *>(&exception) !=
               nullptr ?
             plain_message(exception) :
             exception.what();
  }
} // namespace isochor

#endif
