#include "celltrace/cache/trace.hpp"

#include "cache/trace_file.hpp"
#include "celltrace/error.hpp"

#include <algorithm>
#include <istream>
#include <map>
#include <string>
#include <utility>

namespace celltrace {

using namespace cache_trace;

namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw InputError("cache trace: " + why);
}

constexpr std::uint32_t kAllLines = 1u << (32 - kOperationBits);

/// Returns the shape that two words encode, checked against the cache's own encoding.
CacheConfig config_of(std::uint32_t first, std::uint32_t second) {
  CacheConfig config;
  config.ways = first >> 16;
  config.sets = first & 0xFFFF;
  config.enabled = (second & 1) != 0;
  config.replacement = static_cast<CacheReplacement>(second >> 1);
  if (!config.valid() || config.replacement > CacheReplacement::lru)
    refuse("a cache has a shape that no cache can have");
  return config;
}

/// Decodes the words of one cache.
class Decoder {
public:
  /// Returns the number of requests that were added.
  std::size_t take(CacheTrace& trace, const std::vector<std::uint32_t>& words) {
    const std::size_t before = trace.requests.size();
    for (std::size_t at = 0; at < words.size();) {
      const std::uint32_t word = words[at];
      const std::uint32_t code = word & kOperationMask;
      if (code > kRepeat) refuse("there is an operation that does not exist");
      if (code == kRepeat) {
        repeat(trace, word >> kOperationBits);
        ++at;
        continue;
      }
      const Operation operation = operation_of(word);
      const std::uint32_t more = words_after(operation);
      if (more > words.size() - at - 1) refuse("an operation is cut off");
      if (begun_ == (operation == Operation::begin))
        refuse(begun_ ? "a cache begins twice" : "a cache does not begin with its shape");
      if (operation == Operation::begin) {
        trace.config = config_of(words[at + 1], words[at + 2]);
        begun_ = true;
      } else {
        trace.requests.push_back(request_of(word, more == 1 ? words[at + 1] : 0));
      }
      at += 1 + more;
    }
    return trace.requests.size() - before;
  }

private:
  void repeat(CacheTrace& trace, std::uint32_t times) {
    if (trace.requests.empty() || times == 0) refuse("nothing comes before a repetition");
    CacheRequest& last = trace.requests.back();
    const bool can_be_repeated = last.operation == Operation::read || last.operation == Operation::write;
    if (!can_be_repeated || last.count != 1) refuse("nothing comes before a repetition");
    repetitions_ += times;
    if (repetitions_ > kMaxRepetitions || times > ~std::uint32_t{0} - last.count)
      refuse("it has too many repetitions");
    last.count += times;
  }
  static CacheRequest request_of(std::uint32_t word, std::uint32_t lines) {
    CacheRequest request;
    request.operation = operation_of(word);
    if (is_reference(word)) request.kind = static_cast<std::uint8_t>((word & kOperationMask) % kKinds);
    request.line = word >> kOperationBits;
    if (request.operation != Operation::synchronize) return request;
    if (lines == 0 || lines > kAllLines - request.line) refuse("lines lie out of reach");
    request.count = lines;
    return request;
  }

  /// Limit, so that a replay does not take days.
  static constexpr std::uint64_t kMaxRepetitions = std::uint64_t{1} << 36;

  std::uint64_t repetitions_ = 0;
  bool begun_ = false;
};

class Reader {
public:
  explicit Reader(std::istream& file) : file_(file) {
    std::array<char, kMagic.size()> magic{};
    file_.read(magic.data(), magic.size());
    if (!file_ || magic != kMagic) refuse("the file is none");
  }
  /// Returns false at the end.
  bool next(ChunkHead& head, std::vector<std::uint32_t>& words) {
    if (file_.peek() == std::istream::traits_type::eof()) return false;
    const std::vector<std::uint32_t> numbers = read(3);
    head = {numbers[0], numbers[1], numbers[2]};
    if (head.spe >= kMaxSpes) refuse("there is no SPE " + std::to_string(head.spe));
    if (head.words == 0 || head.words > kMaxChunkWords) refuse("a part has an impossible length");
    words = read(head.words);
    return true;
  }

private:
  std::vector<std::uint32_t> read(std::uint32_t count) {
    bytes_.resize(std::size_t{count} * 4);
    file_.read(reinterpret_cast<char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
    if (!file_) refuse("the file ends too early");
    std::vector<std::uint32_t> words(count);
    for (std::size_t i = 0; i < words.size(); ++i)
      words[i] = bytes_[4 * i] | std::uint32_t{bytes_[4 * i + 1]} << 8 |
                 std::uint32_t{bytes_[4 * i + 2]} << 16 | std::uint32_t{bytes_[4 * i + 3]} << 24;
    return words;
  }

  std::istream& file_;
  std::vector<unsigned char> bytes_;
};

} // namespace

CacheTrace without_prefetches(CacheTrace trace) {
  std::erase_if(trace.requests,
                [](const CacheRequest& request) { return request.operation == Operation::prefetch; });
  return trace;
}

std::vector<CacheTrace> read_cache_traces(std::istream& file, std::uint64_t max_requests) {
  struct Entry {
    CacheTrace trace;
    Decoder decoder;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Entry> caches;
  Reader reader(file);
  ChunkHead head{};
  std::vector<std::uint32_t> words;
  std::uint64_t requests = 0;
  while (reader.next(head, words)) {
    Entry& entry = caches[{head.spe, head.cache}];
    entry.trace.spe = head.spe;
    // A cache counts as a request: a file with nothing but caches must not take more memory either.
    requests += 1 + entry.decoder.take(entry.trace, words);
    if (requests > max_requests) refuse("it has more than " + std::to_string(max_requests) + " requests");
  }
  std::vector<CacheTrace> traces;
  for (auto& [key, entry] : caches)
    traces.push_back(std::move(entry.trace));
  return traces;
}

} // namespace celltrace
