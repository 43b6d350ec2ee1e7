#include "cli/contact_sheet.hpp"

#include <catch2/catch.hpp>

using namespace celltrace::cli;
using Catch::Matchers::Contains;

TEST_CASE("names and errors are text in a contact sheet") {
  ContactSheet sheet;
  sheet.add({SheetEntry::State::failed, "<script>.pov", "a.png", "a & <b> \"c\"", false, 0.5});
  sheet.add({SheetEntry::State::partial, "q.pov", "a \"b\"#?.png", "", false, 1.25});
  sheet.add({SheetEntry::State::done, "d.pov", "d.png", "", false, 0});
  CHECK(sheet.count(SheetEntry::State::done) == 1);
  CHECK(sheet.count(SheetEntry::State::partial) == 1);
  CHECK(sheet.count(SheetEntry::State::failed) == 1);
  const std::string page = sheet.page();
  CHECK_THAT(page, Contains("<pre>a &amp; &lt;b&gt; &quot;c&quot;</pre>") && Contains("&lt;script&gt;.pov"));
  CHECK_THAT(page, Contains("src=\"./a%20%22b%22%23%3F.png\"") && Contains("1.25 s, partial"));
  CHECK_THAT(page, !Contains("<script>") && Contains("1 of 3 scenes rendered"));
}
