#include "celltrace/cache/trace.hpp"

#include "cache/trace_file.hpp"

#include <mutex>
#include <ostream>
#include <unordered_map>

namespace celltrace {

using namespace cache_trace;

namespace {

void append(std::vector<char>& bytes, std::uint32_t number) {
  for (unsigned shift = 0; shift < 32; shift += 8)
    bytes.push_back(static_cast<char>(number >> shift & 0xFF));
}

} // namespace

class CacheTraceWriter::Impl {
public:
  explicit Impl(std::ostream& file) : file_(file), spes_(kMaxSpes) {
    file_.write(kMagic.data(), kMagic.size());
  }

  void record(unsigned spe, const void* source, std::uint32_t word) {
    Spe& from = spes_.at(spe);
    if (source != from.last_source) {
      from.last_source = source;
      from.last = &from.streams[source];
    }
    Stream& stream = *from.last;
    if (stream.words_to_come == 0 && operation_of(word) == Operation::begin) {
      // A new cache lies where an old one was.
      write(spe, stream);
      stream.cache = from.caches++;
    }
    take(spe, stream, word);
  }

  void finish() {
    for (unsigned spe = 0; spe < spes_.size(); ++spe)
      for (auto& [source, stream] : spes_[spe].streams)
        write(spe, stream);
    file_.flush();
  }

private:
  /// The words of one cache.
  struct Stream {
    std::uint32_t cache = 0;
    std::vector<std::uint32_t> words;
    bool after_reference = false;    ///< the last word is a reference, which may be repeated
    std::uint32_t repeats = 0;       ///< repetitions of it that are not yet among the words
    std::uint32_t words_to_come = 0; ///< words still to come that belong to the last operation
  };
  struct Spe {
    std::unordered_map<const void*, Stream> streams;
    const void* last_source = nullptr;
    Stream* last = nullptr;
    std::uint32_t caches = 0;
  };

  void take(unsigned spe, Stream& stream, std::uint32_t word) {
    if (stream.words_to_come != 0) {
      --stream.words_to_come;
    } else {
      if (stream.after_reference && stream.words.back() == word && stream.repeats < kMaxRepeat) {
        ++stream.repeats;
        return;
      }
      end_repeats(stream);
      // Words of one operation stay in one chunk.
      if (stream.words.size() + 4 > kMaxChunkWords) write(spe, stream);
      stream.words_to_come = words_after(operation_of(word));
      stream.after_reference = is_reference(word);
    }
    stream.words.push_back(word);
  }
  static void end_repeats(Stream& stream) {
    if (stream.repeats != 0) stream.words.push_back(stream.repeats << kOperationBits | kRepeat);
    stream.repeats = 0;
  }
  void write(unsigned spe, Stream& stream) {
    end_repeats(stream);
    if (stream.words.empty()) return;
    std::vector<char> bytes;
    bytes.reserve((stream.words.size() + 3) * 4);
    for (const std::uint32_t number : {spe, stream.cache, static_cast<std::uint32_t>(stream.words.size())})
      append(bytes, number);
    for (const std::uint32_t word : stream.words)
      append(bytes, word);
    stream.words.clear();
    stream.after_reference = false;
    const std::lock_guard lock(mutex_);
    file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

  std::mutex mutex_; ///< guards the file
  std::ostream& file_;
  std::vector<Spe> spes_;
};

CacheTraceWriter::CacheTraceWriter(std::ostream& file) : impl_(std::make_unique<Impl>(file)) {
}
CacheTraceWriter::~CacheTraceWriter() {
  finish();
}

void CacheTraceWriter::record(unsigned spe, const void* source, std::uint32_t word) {
  impl_->record(spe, source, word);
}
void CacheTraceWriter::finish() {
  impl_->finish();
}

} // namespace celltrace
