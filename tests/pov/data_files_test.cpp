// #fopen, #read, #write and #fclose. What is expected of values is what POV-Ray 3.7 writes and reads.
#include <filesystem>
#include <iterator>

#include <catch2/catch.hpp>

#include "files.hpp"
#include "pov/parsing.hpp"

#include <sys/stat.h>

using namespace celltrace;
using test::error_line;
using test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

ParseOptions writing_to(const TemporaryFolder& folder) {
  ParseOptions options;
  options.writable_folders = {folder.path()};
  return options;
}

/// What a scene that writes into F leaves in the file.
std::string written(const std::string& text) {
  const TemporaryFolder folder;
  test::parse("#fopen F \"out.txt\" write " + text + " sphere { 0, 1 }", writing_to(folder));
  return test::read_bytes(folder / "out.txt");
}

/// What a scene says that reads from F.
std::string said(const std::string& file, const std::string& text) {
  const TemporaryFolder folder;
  test::write_bytes(folder / "in.txt", file);
  try {
    return test::output("#fopen F \"in.txt\" read " + text + " sphere { 0, 1 }", writing_to(folder));
  } catch (const SceneError& error) {
    const std::string all = error.what();
    return all.substr(all.find("error: "));
  }
}

} // namespace

TEST_CASE("#write writes as POV-Ray does") {
  CHECK(written("#write (F, 1, \",\", <1, 2, 3>, \" \", \"a\\\"b\\n\", 0.1, \"|\", 1e20, \"|\", 1/3, \"|\", "
                "123456789)") == "1,<1,2,3>  a\"b\n0.1|1e+20|0.333333|1.23457e+08");
  CHECK(written("#write (F, <1,2>, <1,2,3,4>, <1,2,3,4,5>, \"\", -1.5, 1e-300 * 1e-300, \" \", 123456, \" "
                "\", 1e15)") == "<1,2> <1,2,3,4> <1,2,3,4,5> -1.50 123456 1e+15");
  CHECK(written("#write (F 1 2 \"x\") #write (F)") == "12x");
  CHECK(written("#write (F, 1) #fclose F #fopen F \"out.txt\" append #write (F, 2)") == "12");
  CHECK(written("#write (F, 1) #fclose F #fopen F \"out.txt\" write #write (F, 2)") == "2");
  CHECK(written("#undef F") == "");
}

TEST_CASE("#read reads as POV-Ray does") {
  const std::string numbers = "#read (F, A, B) #debug concat(str(A, 0, 1), \" \", str(B, 0, 1))";
  CHECK(said("1, 2", numbers) == "1.0 2.0");
  CHECK(said("-1, - 2 , 3", numbers) == "-1.0 -2.0");
  CHECK(said("// one\n1, /* two */ +2", numbers) == "1.0 2.0");
  CHECK(said("1;2;", numbers) == "1.0 2.0");
  CHECK(said("1+1, 2*3", numbers) == "1.0 1.0"); // whatever is behind a value counts as its comma
  CHECK(said("1 2", numbers) == "error: 'B' is not declared");
  CHECK(said("<1,2,3> <4,5,6>", "#read (F, A, B) #debug str(B, 0, 0)") == "4");
  CHECK(said("<1,2>,<1, 2 3,4,-5>",
             "#read (F, A, B) #debug concat(vstr(2, A, \" \", 0, 0), \", \", vstr(5, B, \" \", 0, 0))") ==
        "1 2, 1 2 3 4 -5");
  CHECK(said("\"a\", \"b\\\"c\"", "#read (F, A, B) #debug concat(A, B)") == "ab\"c");
  CHECK(said("1, 2", "#declare A = array[2] {0, 0} #read (F, A[0], A[1]) #debug str(A[1], 0, 0)") == "2");
  CHECK(said("pi", "#read (F, A)") == "error: expected a number, a vector or a string");
  CHECK(said("1,,2", numbers) == "error: expected a number, a vector or a string");
  CHECK(said("<1>", "#read (F, A)") == "error: a vector has at least two components");
  CHECK(said("<1,2,3,4,5,6>", "#read (F, A)") == "error: a vector has at most five components");
  CHECK(said("<1,2", "#read (F, A)") == "error: expected a number");
  CHECK(said("\"a", "#read (F, A)") == "error: this string is never closed");
}

TEST_CASE("the end of a file that is read closes it") {
  const std::string loop = "#while (defined(F)) #read (F, A) #debug concat(str(A, 0, 0), \" \") #end";
  CHECK(said("1, 2", loop) == "1 2 ");
  CHECK(said("1, 2,", loop) == "1 2 2 ");
  CHECK(said("1, 2,\n", loop) == "1 2 2 ");
  CHECK(said("", "#declare A = \"old\"; #read (F, A) #debug A #fclose F") == "old");
  CHECK(said("1", "#read (F, A) #read (F, B)") == "error: 'F' is no file that #fopen has opened");
  CHECK(said("1", "#read (F, A, B, C) #debug str(defined(B) + defined(F), 0, 0)") == "0");
  CHECK(said("1", "#read (F, A) #fopen F \"in.txt\" read #read (F, A) #debug str(A, 0, 0)") == "1");
}

TEST_CASE("what a file cannot be used for") {
  const TemporaryFolder folder;
  test::write_bytes(folder / "in.txt", "1");
  const auto error = [&](const std::string& text) {
    const std::string line = error_line(text, writing_to(folder));
    return line.substr(std::min(line.find("error: "), line.size()));
  };
  CHECK(error("#fopen F \"none.txt\" read") == "error: cannot find the file 'none.txt'");
  CHECK(error("#fopen F \"in.txt\" look") == "error: expected 'read', 'write' or 'append'");
  CHECK(error("#fopen F \"in.txt\" read #write (F, 1)") == "error: 'F' is open for reading, not for writing");
  CHECK(error("#fopen F \"x.txt\" append #read (F, A)") == "error: 'F' is open for writing, not for reading");
  CHECK(error("#declare F = 1; #fopen F \"in.txt\" read") == "error: 'F' is a float already");
  CHECK(error("#fopen F \"x.txt\" write #fopen F \"y.txt\" write") == "error: 'F' is a file already");
  CHECK(error("#write (F, 1)") == "error: 'F' is no file that #fopen has opened");
  CHECK(error("#fopen F \"in.txt\" read #declare S = sphere { 0, 1 } #read (F, S)") ==
        "error: 'S' is an object: #read gives numbers, vectors and strings");
  CHECK(error("#fopen F \"x.txt\" write #write (F, sphere { 0, 1 })") ==
        "error: #write takes numbers, vectors and strings, not an object");
  CHECK(error("#fopen F \"x.txt\" write #declare G = F;") == "error: 'F' is not declared");
  CHECK(error("#fclose F sphere { 0, 1 }") == "");
}

TEST_CASE("an application permits single files, by their names without links") {
  const TemporaryFolder folder, elsewhere;
  std::vector<std::pair<fs::path, FileUse>> asked;
  bool answer = true;
  ParseOptions options;
  options.working_folder = folder.path();
  options.permits = [&](const fs::path& file, FileUse use) {
    asked.emplace_back(file, use);
    return answer;
  };
  fs::create_directory_symlink(elsewhere.path(), folder / "linked");
  const std::string write = "#fopen F \"linked/out.txt\" write #write (F, 1) #fclose F ";
  test::parse(write + "sphere { 0, 1 }", options);
  CHECK(test::read_bytes(elsewhere / "out.txt") == "1");
  CHECK(test::output("#fopen F \"linked/out.txt\" read #read (F, A) #debug str(A, 0, 0) sphere { 0, 1 }",
                     options) == "1");
  REQUIRE(asked.size() == 2);
  CHECK(asked[0] == std::pair(elsewhere / "out.txt", FileUse::write));
  CHECK(asked[1] == std::pair(elsewhere / "out.txt", FileUse::read));
  answer = false;
  CHECK(error_line(write, options) ==
        "scene.pov:1:10: error: file 'linked/out.txt': it lies outside of the folders that povray.conf or "
        "--allow-write lets scenes write in");
  CHECK(error_line("#include \"linked/out.txt\"", options).find("lies outside") != std::string::npos);
  // What its folders allow is not asked about.
  asked.clear();
  options.writable_folders = {elsewhere.path()};
  test::parse(write + "sphere { 0, 1 }", options);
  CHECK(asked.empty());
}

TEST_CASE("a scene writes only where it may") {
  const TemporaryFolder folder, elsewhere;
  const auto error = [&](const std::string& name) {
    const std::string line = error_line("#fopen F \"" + name + "\" write #write (F, 1)", writing_to(folder));
    return line.substr(std::min(line.find("error: "), line.size()));
  };
  CHECK(error_line("#fopen F \"out.txt\" write") ==
        "scene.pov:1:10: error: file 'out.txt': scenes write no files unless --allow-write DIR says in which "
        "folder they may");
  const std::string outside = ": it lies outside of the folders that --allow-write lets scenes write in";
  const std::string other = (elsewhere / "out.txt").string();
  CHECK(error(other) == "error: file '" + other + "'" + outside);
  CHECK(error("../out.txt") == "error: file '../out.txt'" + outside);
  fs::create_directory_symlink(elsewhere.path(), folder / "linked");
  CHECK(error("linked/out.txt") == "error: file 'linked/out.txt'" + outside);
  test::write_bytes(elsewhere / "there.txt", "there");
  fs::create_symlink(elsewhere / "there.txt", folder / "link.txt");
  CHECK(error("link.txt") == "error: file 'link.txt'" + outside);
  fs::create_symlink(elsewhere / "not-there.txt", folder / "dangling.txt");
  CHECK(error("dangling.txt") == "error: file 'dangling.txt': it is a link that leads to no file");
  CHECK(error(".") == "error: file '.': this is no name of a file");
  CHECK(error("none/out.txt").find("its folder is not there") != std::string::npos);
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(error("pipe").find("error: file 'pipe': it ") == 0);
  CHECK(test::read_bytes(elsewhere / "there.txt") == "there");
  CHECK(std::distance(fs::directory_iterator(elsewhere.path()), {}) == 1);
  CHECK(error("out.txt") == "");
  // A link within the folder is followed.
  fs::create_symlink(folder / "out.txt", folder / "again.txt");
  CHECK(error("again.txt") == "");
  CHECK(fs::is_symlink(folder / "again.txt"));
}

TEST_CASE("what a scene has written it can include, and what it writes is bounded") {
  const TemporaryFolder folder;
  CHECK(test::output(
            "#fopen F \"a.inc\" write #write (F, \"#debug \\\"hello\\\"\") #fclose F #include \"a.inc\"",
            writing_to(folder)) == "hello");
  ParseOptions options = writing_to(folder);
  options.limits.written_bytes = 1000;
  CHECK(error_line("#fopen F \"x\" write #while (1) #write (F, \"0123456789\") #end", options) ==
        "scene.pov:1:42: error: the scene writes more than 1000 bytes to files (--max written-bytes=N allows "
        "more)");
  CHECK(test::read_bytes(folder / "x").size() == 1000);
  options.limits.open_files = 3;
  CHECK(error_line("#fopen A \"a\" write #fopen B \"b\" write #fopen C \"c\" write #fopen D \"d\" write",
                   options)
            .find("#fopen keeps more than 3 files open") != std::string::npos);
  if (fs::exists("/dev/full")) {
    options.writable_folders = {"/dev"};
    CHECK(error_line("#fopen F \"/dev/full\" write", options).find("it is not a regular file") !=
          std::string::npos);
  }
}
