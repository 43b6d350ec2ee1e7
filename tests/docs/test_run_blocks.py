#!/usr/bin/env python3
"""Tests what run_blocks.py takes for the output that a page shows."""
import unittest

from run_blocks import is_output


class Output(unittest.TestCase):
    def test_is_as_shown(self):
        self.assertTrue(is_output("64046942", "64046942\n"))
        self.assertFalse(is_output("64046942", "64046943\n"))
        self.assertFalse(is_output("a b", "a  b"))

    def test_has_any_text_for_dots(self):
        self.assertTrue(is_output("a rule: ... [late]", "a rule: EA 0x1234\nand more [late]"))
        self.assertFalse(is_output("a rule: ... [late]", "a rule: [early]"))
        self.assertFalse(is_output("a ... b", "a c d", 2))

    def test_has_numbers_within_a_tolerance(self):
        self.assertTrue(is_output("64046942", "65000000", 2))
        self.assertFalse(is_output("64046942", "67393838", 2))
        self.assertTrue(is_output("0.1245", "0.1225", 2))
        self.assertFalse(is_output("0.1245", "0.1205", 2))
        self.assertTrue(is_output("-1,024 and 1e-3", "-1030 and 0.00101", 2))
        self.assertFalse(is_output("-1,024", "1024", 2))
        self.assertTrue(is_output("0", "0", 2))
        self.assertFalse(is_output("0", "1", 2))

    def test_has_words_exactly(self):
        self.assertTrue(is_output("hits 10   misses 20", "hits  10 misses  20", 2))
        self.assertFalse(is_output("hits 10", "misses 10", 2))
        self.assertFalse(is_output("4x128 10", "4x129 10", 2))  # a shape is a word
        self.assertFalse(is_output("10 %", "10 percent", 2))
        self.assertFalse(is_output("10", "10 11", 2))

    def test_has_all_numbers_checked_around_dots(self):
        self.assertTrue(is_output("1 ... 100", "1 x 5 y 101", 2))
        self.assertFalse(is_output("1 ... 100", "1 x 5 y 103", 2))


if __name__ == "__main__":
    unittest.main()
