// The file of cache traces: what is written is read, and what is damaged is refused.
#include "traces.hpp"

#include "celltrace/error.hpp"

#include <catch2/catch.hpp>

#include <random>
#include <thread>

using namespace celltrace;
using namespace celltrace::test;
using namespace celltrace::cache_trace;

namespace {

std::vector<std::uint32_t> begin_words() {
  const CacheConfig config;
  return {make(Operation::begin), first_word(config), second_word(config)};
}

std::vector<std::uint32_t> with_begin(const std::vector<std::uint32_t>& words) {
  std::vector<std::uint32_t> all = begin_words();
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

/// A file with one chunk of just these words.
std::string chunk(const std::vector<std::uint32_t>& words, std::uint32_t spe = 0) {
  std::string bytes = "CTCACHE1";
  const auto append = [&](std::uint32_t number) {
    for (int shift = 0; shift < 32; shift += 8)
      bytes += static_cast<char>(number >> shift);
  };
  append(spe);
  append(0);
  append(static_cast<std::uint32_t>(words.size()));
  for (const std::uint32_t word : words)
    append(word);
  return bytes;
}

std::string error_in(const std::string& bytes) {
  try {
    traces_in(bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::uint32_t read_of(std::uint32_t line, std::uint32_t kind = 0) {
  return make(Operation::read, line * kLineBytes, kind);
}
constexpr std::uint32_t repeat(std::uint32_t times) {
  return times << kOperationBits | 23;
}

} // namespace

TEST_CASE("all requests are in the file") {
  const std::string file = file_of(
      with_begin({read_of(7, 3), make(Operation::write, 5 * kLineBytes, 2),
                  make(Operation::prefetch, 0x1FFFFFF * kLineBytes),
                  make(Operation::synchronize, 4 * kLineBytes), 9, make(Operation::synchronize_all),
                  make(Operation::invalidate_all), make(Operation::reset_counters), make(Operation::flush)}));
  const std::vector<CacheTrace> traces = traces_in(file);
  REQUIRE(traces.size() == 1);
  const std::vector<CacheRequest> expected = {{Operation::read, 3, 7, 1},
                                              {Operation::write, 2, 5, 1},
                                              {Operation::prefetch, 0, 0x1FFFFFF, 1},
                                              {Operation::synchronize, 0, 4, 9},
                                              {Operation::synchronize_all, 0, 0, 1},
                                              {Operation::invalidate_all, 0, 0, 1},
                                              {Operation::reset_counters, 0, 0, 1},
                                              {Operation::flush, 0, 0, 1}};
  REQUIRE(traces[0].requests.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(i);
    CHECK(traces[0].requests[i].operation == expected[i].operation);
    CHECK(traces[0].requests[i].kind == expected[i].kind);
    CHECK(traces[0].requests[i].line == expected[i].line);
    CHECK(traces[0].requests[i].count == expected[i].count);
  }
}

TEST_CASE("references that are repeated take no room") {
  std::vector<std::uint32_t> words = with_begin({});
  for (int i = 0; i < 100'000; ++i)
    words.push_back(read_of(3));
  words.push_back(read_of(3, 1));
  const std::string file = file_of(words);
  CHECK(file.size() < 64);
  const CacheTrace trace = traces_in(file).at(0);
  REQUIRE(trace.requests.size() == 2);
  CHECK(trace.requests[0].count == 100'000);
  CHECK(trace.requests[1].count == 1);
}

TEST_CASE("traces of any length come back, and take little memory while they are written") {
  std::vector<std::uint32_t> words = with_begin({});
  std::mt19937 random(1);
  for (int i = 0; i < 300'000; ++i) {
    if (random() % 4 == 0) {
      words.push_back(make(Operation::synchronize, random() % 50 * kLineBytes));
      words.push_back(1 + random() % 3);
    } else {
      words.push_back(read_of(random() % 50));
    }
  }
  std::ostringstream file;
  CacheTraceWriter writer(file);
  for (const std::uint32_t word : words)
    writer.record(5, &words, word);
  CHECK(file.str().size() > words.size()); // most of it is written already
  writer.finish();
  const CacheTrace trace = traces_in(file.str()).at(0);
  CHECK(trace.spe == 5);
  std::size_t at = 3;
  std::size_t wrong = 0;
  for (const CacheRequest& request : trace.requests) {
    for (std::uint32_t i = 0; i < (request.operation == Operation::read ? request.count : 1); ++i)
      wrong += words[at++] != make(request.operation, request.line * kLineBytes);
    if (request.operation == Operation::synchronize) wrong += words[at++] != request.count;
  }
  CHECK(at == words.size());
  CHECK(wrong == 0);
}

TEST_CASE("caches are told apart by SPE, by place and by age") {
  std::ostringstream file;
  {
    CacheTraceWriter writer(file);
    const auto record = [&](unsigned spe, int place, const std::vector<std::uint32_t>& words) {
      static const char places[2] = {};
      for (const std::uint32_t word : words)
        writer.record(spe, places + place, word);
    };
    record(2, 0, with_begin({read_of(1)}));
    record(2, 1, with_begin({read_of(2)}));
    record(2, 0, {read_of(3)});
    record(2, 0, with_begin({read_of(4)}));
    record(1, 0, with_begin({read_of(5)}));
    record(2, 1, {read_of(6)});
  }
  const std::vector<CacheTrace> traces = traces_in(file.str());
  const auto lines = [&](std::size_t cache) {
    std::vector<std::uint32_t> all;
    for (const CacheRequest& request : traces.at(cache).requests)
      all.push_back(request.line);
    return all;
  };
  REQUIRE(traces.size() == 4);
  CHECK(traces[0].spe == 1);
  CHECK(traces[3].spe == 2);
  CHECK(lines(0) == std::vector<std::uint32_t>{5});
  CHECK(lines(1) == std::vector<std::uint32_t>{1, 3});
  CHECK(lines(2) == std::vector<std::uint32_t>{2, 6});
  CHECK(lines(3) == std::vector<std::uint32_t>{4});
}

TEST_CASE("SPEs may record at the same time") {
  std::ostringstream file;
  CacheTraceWriter writer(file);
  std::vector<std::thread> spes;
  for (unsigned spe = 0; spe < 4; ++spe)
    spes.emplace_back([&writer, spe] {
      for (const std::uint32_t word : with_begin({}))
        writer.record(spe, &writer, word);
      for (std::uint32_t i = 0; i < 200'000; ++i)
        writer.record(spe, &writer, read_of(i + spe));
    });
  for (std::thread& spe : spes)
    spe.join();
  writer.finish();
  const std::vector<CacheTrace> traces = traces_in(file.str());
  REQUIRE(traces.size() == 4);
  for (const CacheTrace& trace : traces) {
    REQUIRE(trace.requests.size() == 200'000);
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < trace.requests.size(); ++i)
      wrong += trace.requests[i].line != i + trace.spe;
    CHECK(wrong == 0);
  }
}

TEST_CASE("a file without caches has none") {
  CHECK(traces_in(file_of({})).empty());
}

TEST_CASE("what is no cache trace, or a damaged one, is refused in one line") {
  const std::string good = chunk(with_begin({read_of(1), repeat(4), make(Operation::synchronize), 3}));
  REQUIRE(error_in(good).empty());
  CHECK_FALSE(error_in("").empty());
  CHECK_FALSE(error_in("CTCACHE2").empty());
  for (std::size_t length = 0; length < good.size(); ++length)
    if (length != 8) CHECK_FALSE(error_in(good.substr(0, length)).empty());
  const std::vector<std::vector<std::uint32_t>> wrong = {
      {read_of(1)},                                     // no shape
      with_begin({make(Operation::begin), 0x40080, 1}), // twice
      with_begin({24}),                                 // no such operation
      with_begin({0x7F}),
      with_begin({make(Operation::synchronize)}), // cut off
      with_begin({make(Operation::synchronize), 0}),
      with_begin({make(Operation::synchronize, kLineBytes), 1u << 25}),
      with_begin({repeat(1)}),
      with_begin({read_of(1), repeat(0)}),
      with_begin({read_of(1), repeat(1), repeat(1)}),
      with_begin({make(Operation::prefetch), repeat(1)}),
      {repeat(1)},
      {make(Operation::begin), 0x40080},
      {make(Operation::begin), 0x30080, 1},   // 3 ways
      {make(Operation::begin), 0x40000, 1},   // no sets
      {make(Operation::begin), 0x8000800, 1}, // 2048 x 2048
      {make(Operation::begin), 0x40080, 7},   // no such policy
      {make(Operation::begin), 0x40080, ~0u}};
  for (const auto& words : wrong) {
    CAPTURE(words);
    const std::string error = error_in(chunk(words));
    CHECK_THAT(error, Catch::StartsWith("cache trace: "));
    CHECK(error.find('\n') == std::string::npos);
  }
  CHECK_FALSE(error_in(chunk(begin_words(), 256)).empty());
  CHECK_FALSE(error_in(chunk({})).empty());
  CHECK_FALSE(error_in(chunk(std::vector<std::uint32_t>((1 << 16) + 1, read_of(1)))).empty());
}

TEST_CASE("random damage never does more than an error") {
  const std::string good =
      chunk(with_begin({read_of(1), repeat(4), make(Operation::synchronize), 3, make(Operation::flush)}));
  std::mt19937 random(11);
  for (int i = 0; i < 20'000; ++i) {
    std::string bad = good;
    for (unsigned change = 0; change <= random() % 4; ++change)
      bad[random() % bad.size()] = static_cast<char>(random());
    CHECK(error_in(bad).find('\n') == std::string::npos);
  }
}

TEST_CASE("a trace has a limit") {
  std::vector<std::uint32_t> words = with_begin({});
  for (std::uint32_t i = 0; i < 100; ++i)
    words.push_back(read_of(i));
  std::istringstream enough(file_of(words));
  CHECK(read_cache_traces(enough, 101).size() == 1);
  std::istringstream too_many(file_of(words));
  CHECK_THROWS_AS(read_cache_traces(too_many, 100), InputError);
}
