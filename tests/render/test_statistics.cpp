// Reports and counts become the statistics of a frame, and those become JSON.
#include "render/statistics.hpp"

#include <fstream>
#include <iterator>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace celltrace;

namespace {

RenderStatistics collected(Schedule schedule, const std::vector<SpeStatistics>& spes,
                           const std::vector<kernel::ReportRecord>& reports) {
  MachineConfig config;
  config.spes = static_cast<unsigned>(spes.size());
  const auto machine = make_machine(config);
  RenderStatistics statistics;
  statistics.schedule = schedule;
  collect(statistics, *machine, kernel::FrameBlock(), reports, spes);
  return statistics;
}

std::string statistics_document() {
  std::ifstream file(CELLTRACE_SOURCE_DIR "/docs/statistics.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace

TEST_CASE("The imbalance is of rays, and in lockstep of the time in which SPEs did not wait for work") {
  std::vector<kernel::ReportRecord> reports(2);
  reports[0].primary_rays = 300;
  reports[1].shadow_rays = 100;
  reports[0].busy_ticks = 10;
  reports[1].busy_ticks = 90;
  std::vector<SpeStatistics> spes(2);
  spes[0].cycles.total_cycle = 1000;
  spes[0].cycles.channel_stall_cycle = 900;
  spes[1].cycles.total_cycle = 1100;
  spes[1].cycles.channel_stall_cycle = 200;

  const RenderStatistics free = collected(Schedule::free, spes, reports);
  CHECK(free.imbalance == Approx(0.5));
  CHECK(free.render_cycles == 1100);
  const RenderStatistics lockstep = collected(Schedule::lockstep, spes, reports);
  CHECK(lockstep.imbalance == Approx(0.8));
  CHECK(lockstep.spes[1].cycles.channel_stall_cycle == 200);
}

TEST_CASE("What an SPE sent and received is summed up") {
  std::vector<SpeStatistics> spes(2);
  for (SpeStatistics& spe : spes) {
    spe.dma_commands = 1;
    spe.dma_list_elements = 2;
    spe.dma_bytes_read = 3;
    spe.dma_bytes_written = 4;
    spe.signals_sent = 5;
    spe.mailbox_words_sent = 6;
    spe.local_store_peak = 7;
  }
  const RenderStatistics s = collected(Schedule::free, spes, std::vector<kernel::ReportRecord>(2));
  CHECK(s.dma_commands == 2);
  CHECK(s.dma_list_elements == 4);
  CHECK(s.dma_bytes_read == 6);
  CHECK(s.dma_bytes_written == 8);
  CHECK(s.signals == 10);
  CHECK(s.mailbox_words == 12);
  CHECK(s.spes[1].local_store_peak == 7);
}

TEST_CASE("Statistics as JSON name schedule, seed and cycles, and what was broken without addresses") {
  RenderStatistics s;
  s.schedule = Schedule::lockstep;
  s.seed = 0xFFFFFFFFFFFFFFFF;
  s.prepare_cycles = 5;
  s.render_cycles = 6;
  s.spes.resize(1);
  s.spes[0].cycles.total_cycle = 6;
  s.spes[0].cycles.branch_taken_miss = 2;
  Diagnostic broken;
  broken.rule = Rule::transfer_size;
  broken.spe = 3;
  broken.command = 17;
  broken.cycle = 1234;
  broken.ea = 0x7FFFABCD1230;
  broken.text = "SPE 3: get 20 bytes, LS 0x18080 <- EA 0x7fffabcd1230";
  broken.site = {"/where/it/was/built/stream.hpp", 33};
  s.diagnostics.push_back(broken);
  broken.spe = Diagnostic::kPpe;
  s.diagnostics.push_back(broken);

  const std::string text = to_json(s);
  CHECK(text.find("abcd") == std::string::npos);
  CHECK(text.find("built") == std::string::npos);
  const auto json = nlohmann::json::parse(text);
  CHECK(json["schedule"] == "lockstep");
  CHECK(json["seed"] == 0xFFFFFFFFFFFFFFFF);
  CHECK(json["cycles"] == nlohmann::json{{"prepare", 5}, {"render", 6}});
  CHECK(json["spes"][0]["cycles"]["total_cycle"] == 6);
  CHECK(json["spes"][0]["cycles"]["branch_taken_miss"] == 2);
  const auto& first = json["diagnostics"][0];
  CHECK(first["rule"] == name_of(Rule::transfer_size));
  CHECK(first["text"] == text_of(Rule::transfer_size));
  CHECK(first["by"] == "SPE 3");
  CHECK(first["command"] == 17);
  CHECK(first["cycle"] == 1234);
  CHECK(first["file"] == "stream.hpp");
  CHECK(first["line"] == 33);
  CHECK(json["diagnostics"][1]["by"] == "PPE");

  const std::string document = statistics_document();
  for (const auto& [key, value] : first.items()) {
    CAPTURE(key);
    CHECK(document.find("`" + key + "`") != std::string::npos);
  }
}
