#include "cli/keyword_page.hpp"

#include "celltrace/pov.hpp"

namespace celltrace::cli {

namespace {

constexpr std::size_t kWidth = 110;

std::string words_with(Keyword::Support support) {
  std::string text, line;
  for (const Keyword& keyword : keywords()) {
    if (keyword.support != support) continue;
    const std::string word = '`' + keyword.word + '`';
    if (line.size() + 1 + word.size() > kWidth) {
      text += line + '\n';
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return text + line + '\n';
}

} // namespace

std::string keyword_page() {
  return "# Words of the scene language\n\n"
         "Every word that POV-Ray's language reserves, and what becomes of it. `celltrace --list-keywords` "
         "prints this\n"
         "page. All of them may be declared and passed on; a word counts where the scene or one of its "
         "objects uses "
         "it.\n\n"
         "## Supported\n\n"
         "What they mean may still be wanting in places, such as a pattern in a kind of map: that is an "
         "error there.\n\n" +
         words_with(Keyword::Support::full) +
         "\n## Ignored\n\n"
         "They are read and change nothing, because they are about speed or about what is not supported "
         "anyway.\n\n" +
         words_with(Keyword::Support::ignored) +
         "\n## Not supported\n\n"
         "An error, `file:line:column: error: 'blob' is not supported yet`, with one line for each of them "
         "in a scene; "
         "with\n"
         "`--lenient` they are left out, with a warning each: the object, or what the object has of "
         "them.\n\n" +
         words_with(Keyword::Support::none);
}

} // namespace celltrace::cli
