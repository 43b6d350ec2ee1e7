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
         "This page lists every word that POV-Ray's language reserves, and says whether celltrace supports "
         "it. "
         "`celltrace\n"
         "--list-keywords` prints the page. A word that is not supported is an error only if the scene or "
         "one "
         "of its objects\n"
         "uses it. A declaration of it that nothing uses is no error.\n\n"
         "## Supported\n\n"
         "A few uses of these words are not supported and give an error, such as a triangle in "
         "`clipped_by`.\n\n" +
         words_with(Keyword::Support::full) +
         "\n## Ignored\n\n"
         "These words are read and change nothing: they are about speed, or belong to features that are not "
         "supported.\n\n" +
         words_with(Keyword::Support::ignored) +
         "\n## Not supported\n\n"
         "A scene that uses such a word gets one error for it, `file:line:column: error: 'isosurface' is not "
         "supported yet`. With\n"
         "`--lenient` celltrace leaves out the object, or the property of the object, and prints a warning "
         "instead.\n\n" +
         words_with(Keyword::Support::none);
}

} // namespace celltrace::cli
