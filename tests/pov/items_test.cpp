// The tables of items: what each block of the language can have.
#include "pov/items.hpp"
#include "pov/reserved_words.hpp"

#include <catch2/catch.hpp>

#include <set>
#include <string>

using namespace celltrace::pov;

TEST_CASE("an item's word stands once in the table of its block", "[pov]") {
  for (int i = 0; i < kBlocks; ++i) {
    const auto block = static_cast<Block>(i);
    std::set<std::string> words;
    for (const ItemWord& item : item_words(block)) {
      INFO("block " << i << ": " << item.word);
      CHECK(words.insert(item.word).second);
    }
  }
}

TEST_CASE("an item's row says its block and its place in the table", "[pov]") {
  for (const BlockWord& word : block_words()) {
    const Item written = item(word.detail, {});
    INFO(word.text);
    CHECK(std::string(item_words(written.block())[written.number()].word) == word.text);
  }
}

TEST_CASE("an item's word is reserved everywhere", "[pov]") {
  const Names names;
  for (const BlockWord& word : block_words()) {
    INFO(word.text);
    CHECK(names.is_reserved(word.text));
  }
}
