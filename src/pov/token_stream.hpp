// Produces the grammar's input: tokens after directives have been executed, macros and loops replayed, and
// names looked up.
//
// Directives need values, so the stream re-enters the grammar (evaluate). A value may end in the middle of
// what follows: the grammar then hands back its lookahead token.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pov/block.hpp"
#include "pov/input.hpp"
#include "pov/literals.hpp"
#include "pov/value.hpp"

namespace celltrace::pov {

struct Session;
struct TokenSpan;

/// The construct that the grammar is entered for.
enum class Start {
  scene,      ///< the whole scene
  condition,  ///< ( value )
  list,       ///< value, value ... )
  expression, ///< a number
  text,       ///< a string
  value,      ///< anything that can be declared or passed to a macro
  defaults,   ///< { texture ... }
};

struct Terminal {
  int token = 0;  ///< the grammar's number, 0 at the end
  int detail = 0; ///< Names::Entry::detail of a reserved word
  Location where;
  Value value;
};

class TokenStream {
public:
  explicit TokenStream(Session& session);

  void open(std::string text, const std::string& name, std::filesystem::path folder);

  /// Returns what the grammar is entered for, once per entry.
  std::optional<Start> take_start() {
    Level& level = levels_.back();
    if (!level.start_pending) return std::nullopt;
    level.start_pending = false;
    return level.start;
  }
  void next(Terminal& terminal);

  /// For the grammar: reports that the value is complete; `has_lookahead` if next() was called once too
  /// often.
  void finish(Value value, bool has_lookahead);

  /// Enters the grammar and returns the value that it finished with.
  Value evaluate(Start start);

  /// For the grammar, at the front of a list: takes the entries that can be read straight from the file, if a
  /// file is being read.
  void take_literals(std::vector<ListEntry>& list);
  /// For the grammar, behind the brace of a shape: takes the arguments that can be read straight from the
  /// file, or from a recording. If there are any, the next terminal is T_ARGUMENTS.
  void take_arguments(std::vector<ShapeArgument>& arguments);
  /// For the grammar: reads a name, whatever it stands for.
  NameId take_name() { return expect_name("to write to").name; }
  /// For the grammar, inside { }, after a keyword: skips values and { } that can belong to the keyword, up
  /// to, not including, the next keyword or the closing brace.
  void skip_arguments();
  /// For the grammar, after a keyword: skips ( ) if there, and { }.
  void skip_group();
  /// Counts work besides reading tokens, in units of about one token, so that a parse can be cancelled in the
  /// middle of it. Throws Cancelled, or SceneError for a limit.
  void spend(std::uint64_t work) {
    work_ += work;
    if (tokens_read_ + work_ > next_check_) check_limits();
  }

  /// Throws as spend() does, whatever has been counted.
  void check_limits();

  /// Returns how many bytes of the scene's own file have been read, and how many are left.
  std::pair<std::size_t, std::size_t> read_and_left() const;

  /// Closes, at the end of the scene, the files that #write has left open.
  void close_data_files();

  /// Returns how a message names the terminal that next() returned last.
  std::string describe_last() const;
  /// Returns a string with its escapes replaced.
  std::string text_of(const Token& string) const;
  /// Returns the place of the last token; before the grammar is entered, the scene's beginning.
  const Location& last_place() const {
    return levels_.empty() ? kBeginning : levels_.back().last_token.where;
  }
  /// Returns the token from which next() made its last terminal.
  const Token& last_token() const { return levels_.back().last_token; }
  /// Makes next() return its last word again.
  void unread_last();
  /// Returns the folder of the file being read.
  const std::filesystem::path& current_folder() const;
  /// Returns whether there has been no token at all.
  bool is_empty() const { return tokens_read_ <= 1; }

  /// Returns the bytes of a picture file, which is found as include files are; its name may lack the
  /// extension.
  std::string read_picture(const std::string& name, const Location& where);
  /// Returns the bytes of a font file, which is found as include files are; its name may lack `.ttf`.
  std::string read_font(const std::string& name, const Location& where);

private:
  static constexpr Location kBeginning = {};

  /// An open bracket.
  struct Bracket {
    unsigned outside = 0; ///< nesting around it
    bool is_parenthesis = false;
    Block block = Block::none; ///< block whose items are in the bracket
  };

  /// One entry of the grammar.
  struct Level {
    Start start = Start::scene;
    std::size_t base_depth = 0; ///< frames below this depth do not end in this level
    bool start_pending = true;
    bool any_delivered = false;
    bool at_end = false;  ///< true: next() has returned the end, so there is no lookahead to hand back
    unsigned nesting = 0; ///< number of open brackets, and of < and ? that may be brackets
    std::vector<Bracket> enclosing;
    Token last_token;
    int last_terminal = 0;            ///< terminal that last_token became
    std::optional<Terminal> put_back; ///< terminal of last_token that next() returns again
    bool after_operand = false;       ///< the last terminal can end a value
    Value result;
    bool hands_back = false;
  };

  // token_stream.cpp: from tokens to terminals
  void leave_finished_macros(std::size_t depth);
  bool is_inside_value() const;
  Token read();
  bool is_plain_word(const Token& directive) const;
  static void make_room(std::vector<ListEntry>& list, const Scanner& scanner);
  const Location& here() const;
  void deliver(const Token& token, Terminal& terminal);
  void count_brackets(const Token& token);
  Block block() const;
  void end_at(const Token& token, Terminal& terminal);
  bool look_up(const Token& token, Terminal& terminal);
  void interpret(const Token& token, Terminal& terminal) const;
  bool is_old_sign(const Token& token) const;
  void skip_to_depth(std::size_t depth);

  // directives.cpp
  void obey(const Token& directive);
  void declare(bool is_local);
  void skip_deprecation();
  void undefine();
  void set_version(const Token& directive);
  void include(const Token& directive);
  std::string read_file_name(Location& where);
  [[noreturn]] void fail_to_find(const std::string& what, const std::string& wanted,
                                 const Location& where) const;
  std::pair<std::filesystem::path, std::string> read_file(const std::string& what, const std::string& wanted,
                                                          const Location& where);
  void show(const Token& directive, Directive kind);
  bool skip_semicolon();
  void expect_semicolon(const Token& declared);
  void check_semicolon() const;
  Token expect_name(const char* purpose);
  void expect(char punctuation, const char* purpose);
  bool is_defined();
  std::vector<std::size_t> read_subscripts();
  Value& element(Value& array, const std::vector<std::size_t>& subscripts, const Location& where);

  // data_files.cpp
  void open_data_file();
  void close_data_file();
  void read_data();
  void write_data();
  std::shared_ptr<DataFile> expect_data_file(Token& name);
  void forget_data_file(const std::shared_ptr<DataFile>& file, NameId name);
  std::string data_text(const Value& value, const Location& where) const;

  // conditionals.cpp
  double condition_value(Location where);
  bool condition(Location where);
  Token skip_branch(unsigned depth);
  void obey_if(const Token& directive, bool holds);
  void choose_else();
  void obey_switch(const Token& directive);
  void obey_else(const Token& directive, Directive kind);
  void obey_case(const Token& directive);
  void obey_end(const Token& directive);
  void obey_break(const Token& directive);
  bool case_holds(const Token& directive, double value);

  // replay.cpp: macros and loops
  TokenRange take_block(const Token& opening);
  void define_macro(const Token& directive);
  void call(const Token& name, const std::shared_ptr<const Macro>& macro);
  std::shared_ptr<Slot> read_argument(const std::string& call, std::vector<ElementReference>& references);
  Token read_past_directives();
  bool is_lone_element();
  void start_while(const Token& directive);
  void start_for(const Token& directive);
  void start_iteration(bool is_first);
  std::optional<Quantity> replay(std::optional<Quantity> (*take)(Session&, TokenSpan&));
  std::optional<Quantity> replay_value(Start start);
  void replay_vector(Token& bracket);
  void replay_arguments(std::vector<ShapeArgument>& arguments);
  void leave_frame();
  bool leave_frame_at_end();
  std::vector<double> read_numbers(const Location& where);

  Session& session_;
  double started_; ///< processor time of the thread at the start
  std::vector<Level> levels_;
  std::uint64_t tokens_read_ = 0;
  bool skips_semicolon_ = false;         ///< true: one semicolon behind the frame's end is skipped
  std::optional<Token> lacks_semicolon_; ///< name declared at the frame's end, which needs a semicolon
  std::uint64_t work_ = 0;               ///< work besides reading tokens
  std::uint64_t next_check_ = 0;         ///< the number of tokens and work at which to pause next
  std::uint64_t tokens_recorded_ = 0;
  std::uint64_t iterations_ = 0;
  unsigned macro_calls_ = 0;
};

} // namespace celltrace::pov
