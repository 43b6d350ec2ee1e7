// Keys that the viewer presses by itself, and what keys do.
#include "celltrace/error.hpp"
#include "viewer/controls.hpp"
#include "viewer/key_script.hpp"

#include <catch2/catch.hpp>

#include <set>

using namespace celltrace;
using namespace celltrace::viewer;

TEST_CASE("Scripts are of keys, sizes and the mouse") {
  KeyScript script({"Left", "q", "PageUp", "800x600", "drag:-5,20", "look:6,-7", "wheel:-2", "click:7,9"});
  CHECK(script.next()->key.keysym.sym == SDLK_LEFT);
  CHECK(script.next()->key.keysym.sym == SDLK_q);
  const auto page = script.next();
  CHECK(page->kind == KeyScript::Kind::key);
  CHECK(page->key.keysym.sym == SDLK_PAGEUP);
  const auto size = script.next();
  CHECK(size->kind == KeyScript::Kind::size);
  CHECK(size->x == 800);
  CHECK(size->y == 600);
  const auto drag = script.next();
  CHECK(drag->kind == KeyScript::Kind::drag);
  CHECK(drag->x == -5);
  CHECK(drag->y == 20);
  const auto look = script.next();
  CHECK(look->kind == KeyScript::Kind::look);
  CHECK(look->x == 6);
  CHECK(look->y == -7);
  const auto wheel = script.next();
  CHECK(wheel->kind == KeyScript::Kind::wheel);
  CHECK(wheel->y == -2);
  const auto click = script.next();
  CHECK(click->kind == KeyScript::Kind::click);
  CHECK(click->x == 7);
  CHECK(click->y == 9);
  CHECK(!script.next());
}

TEST_CASE("Scripts with anything else are refused") {
  for (const char* word : {"nothing", "0x5", "800x", "800x600x", "drag:1", "look:3", "wheel:", "-3x4"}) {
    INFO(word);
    CHECK_THROWS_AS(KeyScript({word}), InputError);
  }
}

TEST_CASE("No key does two things") {
  std::set<SDL_Keycode> keys;
  std::set<Action> actions;
  for (const Control& control : controls()) {
    CHECK(actions.insert(control.action).second);
    for (const SDL_Keycode key : control.keys) {
      if (key == 0) continue;
      INFO(key);
      CHECK(keys.insert(key).second);
      CHECK(control_of(key) == &control);
    }
  }
  CHECK(control_of(SDLK_F9) == nullptr);
  CHECK(control_of(SDLK_EQUALS) == control_of(SDLK_PLUS));
}
