#!/usr/bin/env python3
"""Grades a replacement policy by what the tracer's software caches were asked for.

    celltrace SCENE.pov --backend cell_emu --cache-trace scene.trace
    grade.py scene.trace policy.py

The cache is fully associative and has 32 lines (--ways); what the program fetched ahead of need is left out, as by
`celltrace replay --no-prefetch --cache 32x1:lru`. docs/software-cache.md describes the file.
"""
import argparse
import array
import collections
import importlib.util
import pathlib
import sys

READS = range(0, 8)
SYNCHRONIZE, SYNCHRONIZE_ALL, INVALIDATE_ALL, RESET_COUNTERS = 17, 18, 19, 20
CONFIGURE, REPEAT = 22, 23


def caches_of(path):
    """By cache its requests: (kind, line), or None where all that it has becomes invalid."""
    data = pathlib.Path(path).read_bytes()
    if data[:8] != b"CTCACHE1":
        sys.exit(f"{path}: not a cache trace")
    words = array.array("I", data[8:])
    if sys.byteorder == "big":
        words.byteswap()
    streams = collections.defaultdict(list)
    at = 0
    while at < len(words):
        spe, cache, count = words[at:at + 3]
        streams[spe, cache].extend(words[at + 3:at + 3 + count])
        at += 3 + count
    return [requests_of(stream) for _, stream in sorted(streams.items())]


def requests_of(words):
    requests = []
    at = 0
    while at < len(words):
        operation, value = words[at] & 127, words[at] >> 7
        at += 1
        if operation in READS:
            requests.append((operation, value))
        elif operation == REPEAT:
            requests += [requests[-1]] * value
        elif operation == CONFIGURE:
            at += 2
        elif operation == RESET_COUNTERS:
            requests.append("reset")
        elif operation in (SYNCHRONIZE, SYNCHRONIZE_ALL, INVALIDATE_ALL):
            requests.append("invalidate")
            at += operation == SYNCHRONIZE
    return requests


class Lru:
    """Least recently used: what has not been asked for the longest time goes first."""

    def __init__(self, ways):
        self.lines = collections.OrderedDict()

    def hit(self, line, kind):
        self.lines.move_to_end(line)

    def fetched(self, line, kind):
        self.lines[line] = True

    def victim(self):
        return self.lines.popitem(last=False)[0]


def hits_of(make_policy, requests, ways):
    """Hits and misses since the counters were last reset."""
    policy, lines = make_policy(ways), set()
    hits = misses = 0
    for request in requests:
        if request == "reset":
            hits = misses = 0
        elif request == "invalidate":
            policy, lines = make_policy(ways), set()
        else:
            kind, line = request
            if line in lines:
                hits += 1
                policy.hit(line, kind)
                continue
            misses += 1
            if len(lines) == ways:
                gone = policy.victim()
                if gone not in lines:
                    sys.exit(f"victim() names {gone}, which is not in the cache")
                lines.remove(gone)
            lines.add(line)
            policy.fetched(line, kind)
    return hits, misses


def hit_rate(make_policy, caches, ways):
    """Percent."""
    results = [hits_of(make_policy, requests, ways) for requests in caches]
    hits, misses = (sum(numbers) for numbers in zip(*results))
    return 100 * hits / (hits + misses)


def policy_of(path):
    specification = importlib.util.spec_from_file_location("policy", path)
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module.Policy


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("trace")
    parser.add_argument("policy", type=pathlib.Path)
    parser.add_argument("--ways", type=int, default=32)
    options = parser.parse_args()

    caches = caches_of(options.trace)
    first = pathlib.Path(__file__).with_name("policy.py")
    yours = hit_rate(policy_of(options.policy), caches, options.ways)
    fifo = hit_rate(policy_of(first), caches, options.ways)
    lru = hit_rate(Lru, caches, options.ways)
    print(f"yours {yours:.3f} %, fifo {fifo:.3f} %, lru {lru:.3f} %")
    points = 0
    for worth, what, reached in ((2, "every victim is in the cache", True), (2, "as good as fifo", yours >= fifo),
                                 (3, "as good as lru", yours >= lru), (3, "better than lru by 0.25 %", yours >= lru + 0.25)):
        print(f"{worth if reached else 0} of {worth}  {what}")
        points += worth if reached else 0
    print(f"{points} of 10 points")
    sys.exit(points < 10)


if __name__ == "__main__":
    main()
