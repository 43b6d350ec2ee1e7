// compare_objdump OBJDUMP FILE: writes each of the 2^11 primary opcodes with 32 different operands to FILE,
// which is as large as a local store, has the SPU's objdump disassemble it, and compares its lines with those
// of the project.
#include "backends/cell_emu/isa/instruction.hpp"

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace celltrace::isa;

constexpr unsigned kPrimaryOpcodes = 2048, kOperands = 32, kOperandBits = 21;

std::vector<std::uint32_t> all_words() {
  std::mt19937 random(1);
  std::vector<std::uint32_t> words;
  for (unsigned operands = 0; operands < kOperands; ++operands)
    for (std::uint32_t primary = 0; primary < kPrimaryOpcodes; ++primary) {
      std::uint32_t low = random();
      if (operands == 0) low = 0;
      if (operands == 1) low = ~0u;
      if (operands < 8) low &= 1u << random() % kOperandBits | 0x7F;
      words.push_back(primary << kOperandBits | (low & ((1u << kOperandBits) - 1)));
    }
  return words;
}

void write(const char* path, const std::vector<std::uint32_t>& words) {
  std::ofstream file(path, std::ios::binary);
  for (const std::uint32_t word : words)
    for (int shift = 24; shift >= 0; shift -= 8)
      file.put(static_cast<char>(word >> shift & 0xFF));
}

struct Line {
  unsigned address;
  std::string text;
};

/// "  1a0:<tab>1c 01 02 03 <tab>ai<tab>$3,$4,4": false for lines of another kind.
bool parse(const std::string& from, Line& line) {
  const std::size_t bytes = from.find(":\t");
  if (bytes == std::string::npos) return false;
  const std::size_t text = from.find('\t', bytes + 2);
  if (text == std::string::npos) return false;
  line.address = static_cast<unsigned>(std::strtoul(from.c_str(), nullptr, 16));
  line.text = from.substr(text + 1, from.find_last_not_of('\n') - text);
  return true;
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: compare_objdump OBJDUMP FILE\n";
    return 2;
  }
  const std::vector<std::uint32_t> words = all_words();
  write(argv[2], words);
  const std::string command = std::string("'") + argv[1] + "' -D -z -b binary -m spu -EB '" + argv[2] + "'";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) {
    std::cerr << "cannot run " << command << '\n';
    return 2;
  }
  std::size_t compared = 0, different = 0;
  Line line;
  for (char text[256]; std::fgets(text, sizeof text, pipe.get()) != nullptr;) {
    if (!parse(text, line) || line.address / 4 >= words.size()) continue;
    ++compared;
    const std::uint32_t word = words[line.address / 4];
    const std::string ours = disassemble(word, line.address);
    if (ours == line.text) continue;
    if (++different <= 20)
      std::printf("%08" PRIx32 " at %x: objdump \"%s\", celltrace \"%s\"\n", word, line.address,
                  line.text.c_str(), ours.c_str());
  }
  std::printf("%zu words, %zu different\n", compared, different);
  return compared == words.size() && different == 0 ? 0 : 1;
}
