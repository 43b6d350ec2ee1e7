#include "backends/cell_emu/simulator/ppe/printf_format.hpp"

#include "backends/cell_emu/simulator/ppe/format_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace celltrace::cell_emu {

std::size_t FormattedText::grow(std::uint64_t count) {
  length_ += count;
  if (length_ > kMostBytes) throw CallFailed{SpuErrno::overflow};
  return static_cast<std::size_t>(
      std::min(count, most_kept_ - std::min<std::uint64_t>(most_kept_, kept_.size())));
}

void FormattedText::append(std::string_view text) {
  kept_.append(text.substr(0, grow(text.size())));
}

void FormattedText::fill(char character, std::uint64_t count) {
  kept_.append(grow(count), character);
}

namespace {

struct Directive {
  bool left = false, plus = false, space = false, alternative = false, zero = false;
  std::uint64_t width = 0;
  std::int64_t precision = -1; ///< negative: no precision
  Length length = Length::normal;
  char conversion = 0;
};

/// The output of a conversion, in order; members with `zeros` in their names are numbers of zeros.
struct Pieces {
  std::string_view sign = {};
  std::uint64_t leading_zeros = 0;
  std::string_view digits = {};
  std::uint64_t trailing_zeros = 0;
  std::string_view suffix = {};

  std::uint64_t size() const {
    return sign.size() + leading_zeros + digits.size() + trailing_zeros + suffix.size();
  }
};

/// Largest number of digits of a double before, or behind, the point, without zeros at the end.
constexpr std::int64_t kMostDigits = 1100;

class Formatter {
public:
  Formatter(FormattedText& text, std::string_view format, const LocalStoreView& local_store,
            VariableArguments arguments)
      : text_(text), format_(format), local_store_(local_store), arguments_(arguments) {}

  void run() {
    while (!format_.at_end()) {
      text_.append(format_.take_until('%'));
      if (!format_.at_end()) convert();
    }
  }

private:
  void convert() {
    const std::size_t start = format_.place();
    format_.take();
    Directive d;
    read_flags(d);
    read_width(d);
    read_precision(d);
    d.length = format_.read_length();
    if (format_.at_end()) throw CallFailed{SpuErrno::invalid};
    d.conversion = format_.take();
    switch (d.conversion) {
    case 'd':
    case 'i':
      put_signed(d);
      break;
    case 'o':
      put_unsigned(d, unsigned_argument(d), 8);
      break;
    case 'u':
      put_unsigned(d, unsigned_argument(d), 10);
      break;
    case 'x':
    case 'X':
      put_unsigned(d, unsigned_argument(d), 16);
      break;
    case 'p':
      put_pointer(d);
      break;
    case 'c':
      put_character(d);
      break;
    case 'C':
      d.length = Length::word;
      put_character(d);
      break;
    case 's':
      put_string(d);
      break;
    case 'S':
      d.length = Length::word;
      put_string(d);
      break;
    case 'a':
    case 'A':
    case 'e':
    case 'E':
    case 'f':
    case 'F':
    case 'g':
    case 'G':
      put_floating(d);
      break;
    case 'n':
      store_count(d);
      break;
    case '%':
      text_.append("%");
      break;
    default:
      text_.append(format_.since(start));
    }
  }

  void read_flags(Directive& d) {
    for (; !format_.at_end(); format_.take())
      switch (format_.peek()) {
      case '-':
        d.left = true;
        break;
      case '+':
        d.plus = true;
        break;
      case ' ':
        d.space = true;
        break;
      case '#':
        d.alternative = true;
        break;
      case '0':
        d.zero = true;
        break;
      case '\'':
        break; // the "C" locale does not group digits
      default:
        return;
      }
  }

  void read_width(Directive& d) {
    if (format_.skip('*')) {
      const std::int64_t width = static_cast<std::int32_t>(arguments_.word());
      d.left |= width < 0;
      d.width = static_cast<std::uint64_t>(std::abs(width));
    } else {
      d.width = format_.read_number();
    }
  }

  void read_precision(Directive& d) {
    if (!format_.skip('.')) return;
    d.precision = format_.skip('*') ? static_cast<std::int32_t>(arguments_.word())
                                    : static_cast<std::int64_t>(format_.read_number());
  }

  void put(const Directive& d, Pieces pieces, bool zeros_allowed = true) {
    std::uint64_t padding = d.width > pieces.size() ? d.width - pieces.size() : 0;
    if (d.zero && !d.left && zeros_allowed) {
      pieces.leading_zeros += padding;
      padding = 0;
    }
    if (!d.left) text_.fill(' ', padding);
    text_.append(pieces.sign);
    text_.fill('0', pieces.leading_zeros);
    text_.append(pieces.digits);
    text_.fill('0', pieces.trailing_zeros);
    text_.append(pieces.suffix);
    if (d.left) text_.fill(' ', padding);
  }

  // --- integers
  // -----------------------------------------------------------------------------------------------

  std::int64_t signed_argument(const Directive& d) {
    if (d.length == Length::two_words) return static_cast<std::int64_t>(arguments_.doubleword());
    const std::uint32_t word = arguments_.word();
    if (d.length == Length::byte) return static_cast<std::int8_t>(word);
    if (d.length == Length::half) return static_cast<std::int16_t>(word);
    return static_cast<std::int32_t>(word);
  }

  std::uint64_t unsigned_argument(const Directive& d) {
    if (d.length == Length::two_words) return arguments_.doubleword();
    const std::uint32_t word = arguments_.word();
    if (d.length == Length::byte) return word & 0xFF;
    if (d.length == Length::half) return word & 0xFFFF;
    return word;
  }

  void put_signed(const Directive& d) {
    const std::int64_t value = signed_argument(d);
    const std::uint64_t magnitude =
        value < 0 ? ~static_cast<std::uint64_t>(value) + 1 : static_cast<std::uint64_t>(value);
    put_integer(d, sign_of(d, value < 0), magnitude, 10);
  }

  void put_unsigned(const Directive& d, std::uint64_t value, int base) {
    const bool prefix = d.alternative && base == 16 && value != 0;
    put_integer(d, !prefix ? "" : d.conversion == 'X' ? "0X" : "0x", value, base);
  }

  void put_pointer(const Directive& d) {
    const std::uint32_t pointer = arguments_.word();
    if (pointer == 0)
      put(d, {.digits = "(nil)"}, false);
    else
      put_integer(d, "0x", pointer, 16);
  }

  void put_integer(const Directive& d, std::string_view sign, std::uint64_t value, int base) {
    std::array<char, 24> buffer;
    const char* end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, base).ptr;
    if (d.conversion == 'X') upper_case(buffer.data(), end);
    Pieces pieces{.sign = sign, .digits = {buffer.data(), static_cast<std::size_t>(end - buffer.data())}};
    if (value == 0 && d.precision == 0) pieces.digits = {};
    if (d.precision > static_cast<std::int64_t>(pieces.digits.size()))
      pieces.leading_zeros = static_cast<std::uint64_t>(d.precision) - pieces.digits.size();
    const bool octal_prefix = d.alternative && d.conversion == 'o';
    if (octal_prefix && pieces.leading_zeros == 0 && !pieces.digits.starts_with('0'))
      pieces.leading_zeros = 1;
    put(d, pieces, d.precision < 0);
  }

  // --- characters
  // ---------------------------------------------------------------------------------------------

  static char narrow(std::uint32_t wide) {
    if (wide >= 0x80) throw CallFailed{SpuErrno::illegal_sequence};
    return static_cast<char>(wide);
  }

  void put_character(const Directive& d) {
    const std::uint32_t word = arguments_.word();
    const char character = d.length == Length::word ? narrow(word) : static_cast<char>(word);
    put(d, {.digits = {&character, 1}}, false);
  }

  void put_string(const Directive& d) {
    const std::uint32_t address = arguments_.word();
    if (address == 0) {
      put(d, {.digits = d.precision >= 0 && d.precision < 6 ? "" : "(null)"}, false);
      return;
    }
    if (d.length == Length::word) {
      const std::string narrowed = narrow_string(d, address);
      put(d, {.digits = narrowed}, false);
      return;
    }
    const bool limited = d.precision >= 0 && d.precision < LocalStoreView::kBytes;
    put(d,
        {.digits = limited ? local_store_.string_up_to(address, static_cast<std::uint64_t>(d.precision))
                           : local_store_.string(address)},
        false);
  }

  std::string narrow_string(const Directive& d, std::uint32_t address) {
    std::string narrowed;
    while (d.precision < 0 || narrowed.size() < static_cast<std::uint64_t>(d.precision)) {
      const auto wide = local_store_.load<std::uint32_t>(address);
      if (wide == 0) break;
      narrowed += narrow(wide);
      if (narrowed.size() >= LocalStoreView::kBytes) throw CallFailed{SpuErrno::fault};
      address += 4;
    }
    return narrowed;
  }

  // --- floating point
  // -----------------------------------------------------------------------------------------

  static std::string_view sign_of(const Directive& d, bool negative) {
    return negative ? "-" : d.plus ? "+" : d.space ? " " : "";
  }

  static void upper_case(char* first, const char* last) {
    for (; first != last; ++first)
      if (*first >= 'a' && *first <= 'z') *first = static_cast<char>(*first - 'a' + 'A');
  }

  void put_floating(Directive d) {
    const double value = arguments_.floating();
    const bool upper = d.conversion < 'a';
    const std::string_view sign = sign_of(d, std::signbit(value));
    if (!std::isfinite(value)) {
      const std::string_view name = std::isnan(value) ? (upper ? "NAN" : "nan") : upper ? "INF" : "inf";
      put(d, {.sign = sign, .digits = name}, false);
      return;
    }
    const double magnitude = std::abs(value);
    switch (d.conversion) {
    case 'a':
    case 'A':
      put_hexadecimal(d, sign, magnitude);
      break;
    case 'e':
    case 'E':
      put_scientific(d, sign, magnitude, d.precision < 0 ? 6 : d.precision);
      break;
    case 'f':
    case 'F':
      put_fixed(d, sign, magnitude, d.precision < 0 ? 6 : d.precision);
      break;
    default:
      put_general(d, sign, magnitude);
    }
  }

  /// Returns the digits, with at most kMostDigits behind the point, because all further digits are zeros.
  std::string_view digits_of(double magnitude, std::chars_format format, std::int64_t precision) {
    const int digits = static_cast<int>(std::min(precision, kMostDigits));
    char* end = std::to_chars(buffer_.data(), buffer_.data() + buffer_.size(), magnitude, format, digits).ptr;
    return {buffer_.data(), static_cast<std::size_t>(end - buffer_.data())};
  }

  static std::uint64_t zeros_beyond(std::int64_t precision) {
    return precision > kMostDigits ? static_cast<std::uint64_t>(precision - kMostDigits) : 0;
  }

  void put_fixed(const Directive& d, std::string_view sign, double magnitude, std::int64_t precision) {
    std::string digits(digits_of(magnitude, std::chars_format::fixed, precision));
    std::uint64_t zeros = zeros_beyond(precision);
    finish_fraction(d, digits, zeros);
    put(d, {.sign = sign, .digits = digits, .trailing_zeros = zeros});
  }

  void put_scientific(const Directive& d, std::string_view sign, double magnitude, std::int64_t precision) {
    const std::string_view all = digits_of(magnitude, std::chars_format::scientific, precision);
    const std::size_t e = all.find('e');
    std::string digits(all.substr(0, e)), exponent(all.substr(e));
    if (d.conversion < 'a') exponent[0] = 'E';
    std::uint64_t zeros = zeros_beyond(precision);
    finish_fraction(d, digits, zeros);
    put(d, {.sign = sign, .digits = digits, .trailing_zeros = zeros, .suffix = exponent});
  }

  /// Drops zeros at the end for %g, unless the flag # is set.
  static void finish_fraction(const Directive& d, std::string& digits, std::uint64_t& zeros) {
    const bool general = d.conversion == 'g' || d.conversion == 'G';
    if (general && !d.alternative) {
      zeros = 0;
      if (digits.find('.') == std::string::npos) return;
      digits.erase(digits.find_last_not_of('0') + 1);
      if (digits.back() == '.') digits.pop_back();
    } else if (d.alternative && digits.find('.') == std::string::npos) {
      digits += '.';
    }
  }

  void put_general(const Directive& d, std::string_view sign, double magnitude) {
    const std::int64_t precision = d.precision < 0 ? 6 : std::max<std::int64_t>(d.precision, 1);
    const std::string_view all = digits_of(magnitude, std::chars_format::scientific, precision - 1);
    int exponent = 0;
    const char* digits = all.data() + all.find('e') + 1;
    std::from_chars(digits + (*digits == '+' ? 1 : 0), all.data() + all.size(), exponent);
    if (exponent < -4 || exponent >= precision)
      put_scientific(d, sign, magnitude, precision - 1);
    else
      put_fixed(d, sign, magnitude, precision - 1 - exponent);
  }

  void put_hexadecimal(const Directive& d, std::string_view sign, double magnitude) {
    constexpr unsigned kFractionBits = 52, kFractionDigits = 13;
    const auto bits = std::bit_cast<std::uint64_t>(magnitude);
    std::uint64_t fraction = bits & ((std::uint64_t{1} << kFractionBits) - 1);
    const unsigned field = static_cast<unsigned>(bits >> kFractionBits);
    if (field != 0) fraction |= std::uint64_t{1} << kFractionBits;
    const int exponent = magnitude == 0 ? 0 : field == 0 ? -1022 : static_cast<int>(field) - 1023;

    unsigned digits = kFractionDigits;
    if (d.precision >= 0 && d.precision < kFractionDigits) {
      digits = static_cast<unsigned>(d.precision);
      const unsigned dropped = kFractionBits - 4 * digits;
      const std::uint64_t half = std::uint64_t{1} << (dropped - 1), rest = fraction & (2 * half - 1);
      fraction >>= dropped;
      if (rest > half || (rest == half && (fraction & 1) != 0)) ++fraction;
    } else if (d.precision < 0) {
      for (; digits > 0 && (fraction & 15) == 0; --digits)
        fraction >>= 4;
    }

    std::string text = std::to_string(fraction >> 4 * digits);
    if (digits > 0 || d.alternative || d.precision > 0) text += '.';
    for (unsigned i = digits; i-- > 0;)
      text += "0123456789abcdef"[fraction >> 4 * i & 15];
    std::string suffix = (exponent < 0 ? "p" : "p+") + std::to_string(exponent), prefix(sign);
    prefix += "0x";
    if (d.conversion == 'A') {
      for (std::string* part : {&text, &suffix, &prefix})
        upper_case(part->data(), part->data() + part->size());
    }
    const std::uint64_t zeros =
        d.precision > kFractionDigits ? static_cast<std::uint64_t>(d.precision) - kFractionDigits : 0;
    put(d, {.sign = prefix, .digits = text, .trailing_zeros = zeros, .suffix = suffix});
  }

  // --- %n
  // -----------------------------------------------------------------------------------------------------

  void store_count(const Directive& d) {
    const std::uint32_t address = arguments_.word();
    const std::uint64_t count = text_.length();
    store_integer(local_store_, address, d.length, count);
  }

  FormattedText& text_;
  FormatText format_;
  LocalStoreView local_store_;
  VariableArguments arguments_;
  std::array<char, kMostDigits + 400> buffer_;
};

} // namespace

void format_printf(FormattedText& text, std::string_view format, const LocalStoreView& local_store,
                   VariableArguments arguments) {
  Formatter(text, format, local_store, arguments).run();
}

} // namespace celltrace::cell_emu
