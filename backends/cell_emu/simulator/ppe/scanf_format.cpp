#include "backends/cell_emu/simulator/ppe/scanf_format.hpp"

#include "backends/cell_emu/simulator/ppe/format_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace celltrace::cell_emu {

namespace {

constexpr int kEnd = -1;

bool is_space(int c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}
int lower(int c) {
  return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c;
}
int digit_value(int c) {
  if (c >= '0' && c <= '9') return c - '0';
  return lower(c) >= 'a' && lower(c) <= 'z' ? lower(c) - 'a' + 10 : 99;
}

struct Directive {
  bool stored = true;
  std::uint64_t width = 0; ///< 0: unlimited
  Length length = Length::normal;
  char conversion = 0;
};

/// The input of one conversion: at most `width` characters.
class Field {
public:
  Field(CharacterSource& source, std::uint64_t& consumed, std::uint64_t width)
      : source_(source), consumed_(consumed), left_(width) {}

  /// Returns the next character without taking it, or kEnd.
  int peek() {
    if (left_ == 0) return kEnd;
    const int c = source_.get();
    if (c != kEnd) source_.unget(c);
    return c;
  }
  void take() {
    source_.get();
    ++consumed_;
    --left_;
  }
  bool take_if(int lower_case) {
    if (lower(peek()) != lower_case) return false;
    take();
    return true;
  }

private:
  CharacterSource& source_;
  std::uint64_t& consumed_;
  std::uint64_t left_;
};

/// Exceptions that end a call of scan_formatted(); results that were stored before stay.
struct InputFailed {};
struct MatchFailed {};

class Scanner {
public:
  Scanner(CharacterSource& source, std::string_view format, const LocalStoreView& local_store,
          VariableArguments arguments)
      : source_(source), format_(format), local_store_(local_store), arguments_(arguments) {}

  int run() {
    try {
      while (!format_.at_end())
        step();
    } catch (const MatchFailed&) {
    } catch (const InputFailed&) {
      if (stored_ == 0) return -1;
    }
    return stored_;
  }

private:
  void step() {
    const char c = format_.take();
    if (is_space(c))
      skip_spaces();
    else if (c != '%')
      match(c);
    else
      convert();
  }

  void skip_spaces() {
    Field field(source_, consumed_, std::numeric_limits<std::uint64_t>::max());
    while (is_space(field.peek()))
      field.take();
  }

  void match(char expected) {
    Field field(source_, consumed_, 1);
    const int c = field.peek();
    if (c == kEnd) throw InputFailed();
    if (c != static_cast<unsigned char>(expected)) throw MatchFailed();
    field.take();
  }

  void convert() {
    Directive d;
    if (format_.skip('*')) d.stored = false;
    d.width = format_.read_number();
    d.length = format_.read_length();
    if (format_.at_end()) throw CallFailed{SpuErrno::invalid};
    d.conversion = format_.take();
    if (d.conversion == 'n') {
      if (d.stored) store_integer(local_store_, arguments_.word(), d.length, consumed_);
      return;
    }
    if (d.conversion == 'C' || d.conversion == 'S') {
      d.length = Length::word;
      d.conversion = static_cast<char>(lower(d.conversion));
    }
    if (d.conversion != 'c' && d.conversion != '[') skip_spaces();
    if (d.conversion == '%') {
      match('%');
      return;
    }
    Field field(source_, consumed_, d.width != 0 ? d.width : d.conversion == 'c' ? 1 : ~std::uint64_t{0});
    if (field.peek() == kEnd) throw InputFailed();
    switch (d.conversion) {
    case 'd':
      integer(d, field, 10, true);
      break;
    case 'i':
      integer(d, field, 0, true);
      break;
    case 'o':
      integer(d, field, 8, false);
      break;
    case 'u':
      integer(d, field, 10, false);
      break;
    case 'x':
    case 'X':
    case 'p':
      integer(d, field, 16, false);
      break;
    case 'a':
    case 'A':
    case 'e':
    case 'E':
    case 'f':
    case 'F':
    case 'g':
    case 'G':
      floating(d, field);
      break;
    case 'c':
      characters(
          d, field, [](int) { return true; }, false);
      break;
    case 's':
      characters(
          d, field, [](int c) { return !is_space(c); }, true);
      break;
    case '[': {
      const std::array<bool, 256> set = read_set();
      characters(
          d, field, [&set](int c) { return set[static_cast<unsigned>(c)]; }, true);
      break;
    }
    default:
      throw CallFailed{SpuErrno::invalid};
    }
    if (d.stored) ++stored_;
  }

  std::array<bool, 256> read_set() {
    std::array<bool, 256> set{};
    const bool inverted = format_.skip('^');
    for (bool first = true;; first = false) {
      if (format_.at_end()) throw CallFailed{SpuErrno::invalid};
      const auto from = static_cast<unsigned char>(format_.take());
      if (from == ']' && !first) break;
      auto to = from;
      if (format_.skips_to_another('-', ']')) to = static_cast<unsigned char>(format_.take());
      for (unsigned c = from; c <= to; ++c)
        set[c] = true;
    }
    if (inverted)
      for (bool& member : set)
        member = !member;
    return set;
  }

  // --- integers
  // -----------------------------------------------------------------------------------------------

  void integer(const Directive& d, Field& field, unsigned base, bool is_signed) {
    const bool negative = field.peek() == '-';
    if (negative || field.peek() == '+') field.take();
    bool digits = false;
    if ((base == 0 || base == 16) && field.peek() == '0') {
      field.take();
      if (field.take_if('x')) {
        base = 16;
      } else {
        digits = true;
        if (base == 0) base = 8;
      }
    }
    if (base == 0) base = 10;

    std::uint64_t value = 0;
    bool overflow = false;
    while (field.peek() != kEnd && digit_value(field.peek()) < static_cast<int>(base)) {
      const auto digit = static_cast<unsigned>(digit_value(field.peek()));
      overflow |= value > (~std::uint64_t{0} - digit) / base;
      value = value * base + digit;
      digits = true;
      field.take();
    }
    if (!digits) throw MatchFailed();
    if (d.stored)
      store_integer(local_store_, arguments_.word(), d.length,
                    saturated(d, value, overflow, negative, is_signed));
  }

  /// Returns the value, or, if it does not fit, the limit that strtol() or strtoul() would return.
  static std::uint64_t saturated(const Directive& d, std::uint64_t value, bool overflow, bool negative,
                                 bool is_signed) {
    const std::uint64_t all = d.length == Length::two_words ? ~std::uint64_t{0} : 0xFFFFFFFF;
    if (!is_signed) {
      if (overflow || value > all) return all;
      return negative ? ~value + 1 : value;
    }
    const std::uint64_t most = all / 2 + (negative ? 1 : 0);
    if (overflow || value > most) value = most;
    return negative ? ~value + 1 : value;
  }

  // --- floating point
  // -----------------------------------------------------------------------------------------

  void floating(const Directive& d, Field& field) {
    const bool negative = field.peek() == '-';
    if (negative || field.peek() == '+') field.take();
    double value = magnitude(field);
    if (negative) value = -value;
    if (!d.stored) return;
    const std::uint32_t address = arguments_.word();
    if (d.length == Length::word || d.length == Length::two_words)
      local_store_.store(address, std::bit_cast<std::uint64_t>(value));
    else
      local_store_.store(address, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  }

  static double magnitude(Field& field) {
    if (lower(field.peek()) == 'i') {
      take_word(field, "inf");
      if (lower(field.peek()) == 'i') take_word(field, "inity");
      return std::numeric_limits<double>::infinity();
    }
    if (lower(field.peek()) == 'n') {
      take_word(field, "nan");
      return std::numeric_limits<double>::quiet_NaN();
    }
    return number(field);
  }

  static void take_word(Field& field, std::string_view word) {
    for (const char c : word)
      if (!field.take_if(c)) throw MatchFailed();
  }

  static double number(Field& field) {
    std::string text;
    bool hexadecimal = false, digits = false;
    if (field.peek() == '0') {
      field.take();
      hexadecimal = field.take_if('x');
      if (!hexadecimal) {
        text += '0';
        digits = true;
      }
    }
    digits |= take_digits(field, text, hexadecimal);
    if (field.take_if('.')) {
      text += '.';
      digits |= take_digits(field, text, hexadecimal);
    }
    if (!digits) throw MatchFailed();
    if (field.take_if(hexadecimal ? 'p' : 'e')) {
      text += hexadecimal ? 'p' : 'e';
      if (field.peek() == '-' || field.peek() == '+') {
        text += static_cast<char>(field.peek());
        field.take();
      }
      if (!take_digits(field, text, false)) throw MatchFailed();
    }
    return parse(text, hexadecimal);
  }

  static bool take_digits(Field& field, std::string& text, bool hexadecimal) {
    constexpr std::size_t kLongestNumber = 65536;
    bool any = false;
    for (int c = field.peek(); c != kEnd && digit_value(c) < (hexadecimal ? 16 : 10); c = field.peek()) {
      if (text.size() >= kLongestNumber) throw MatchFailed();
      text += static_cast<char>(c);
      any = true;
      field.take();
    }
    return any;
  }

  static double parse(const std::string& text, bool hexadecimal) {
    double value = 0;
    const auto format = hexadecimal ? std::chars_format::hex : std::chars_format::general;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value, format);
    if (result.ec != std::errc::result_out_of_range) return value;
    const std::size_t exponent = text.find(hexadecimal ? 'p' : 'e');
    const bool tiny = exponent != std::string::npos ? text[exponent + 1] == '-' : text.find('.') < 2;
    return tiny ? 0 : std::numeric_limits<double>::infinity();
  }

  // --- characters
  // ---------------------------------------------------------------------------------------------

  template <class Member>
  void characters(const Directive& d, Field& field, const Member& member, bool terminated) {
    std::uint32_t address = d.stored ? arguments_.word() : 0;
    bool any = false;
    for (int c = field.peek(); c != kEnd && member(c); c = field.peek()) {
      if (d.stored) address = store_character(d, address, static_cast<unsigned>(c));
      any = true;
      field.take();
    }
    if (!any) throw MatchFailed();
    if (d.stored && terminated) store_character(d, address, 0);
  }

  std::uint32_t store_character(const Directive& d, std::uint32_t address, unsigned c) {
    const bool wide = d.length == Length::word;
    if (wide)
      local_store_.store(address, static_cast<std::uint32_t>(c));
    else
      local_store_.store(address, static_cast<std::uint8_t>(c));
    const std::uint32_t next = address + (wide ? 4 : 1);
    if (LocalStoreView::wrap(next) == 0)
      throw CallFailed{SpuErrno::fault}; // strings must not continue at address 0
    return next;
  }

  CharacterSource& source_;
  FormatText format_;
  LocalStoreView local_store_;
  VariableArguments arguments_;
  std::uint64_t consumed_ = 0;
  int stored_ = 0;
};

} // namespace

int scan_formatted(CharacterSource& source, std::string_view format, const LocalStoreView& local_store,
                   VariableArguments arguments) {
  return Scanner(source, format, local_store, arguments).run();
}

} // namespace celltrace::cell_emu
