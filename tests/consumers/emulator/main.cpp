// Runs a program for the SDK on emulated SPEs, and finds its mistake.
#include <celltrace/emulator.hpp>
#include <spu_mfcio.h>

#include <cstdio>

namespace {

alignas(128) float data[32] = {1, 2, 3};
float seen = 0;

int copy_main(unsigned long long, unsigned long long argp, unsigned long long wait) {
  static celltrace::LocalStore<float[32]> buffer;
  mfc_get(*buffer, argp, sizeof data, 0, 0, 0);
  if (wait != 0) {
    mfc_write_tag_mask(1);
    mfc_read_tag_status_all();
  }
  seen = (*buffer)[2];
  return 7;
}

} // namespace

int main() {
  const auto run =
      celltrace::emulate(celltrace::lockstep(1), celltrace::spe_main(copy_main, 1), celltrace::to_ea(data));
  std::printf("%s%llu cycles\n", run.report().c_str(), static_cast<unsigned long long>(run.cycles));
  if (!run.ok() || seen != 3 || run.exit_codes[0] != 7) return 1;
  // What is computed on emulated SPEs is counted by inline code here, and charged by the library.
  const auto cycles = [](bool computing) {
    return celltrace::emulate(celltrace::lockstep(1),
                              [computing](celltrace::EmulatedSpu& spu) {
                                using F = celltrace::EmulatedSpu::simd::F;
                                F sum(0.0f);
                                for (int i = 0; computing && i < 100; ++i)
                                  sum = sum + F(1.0f);
                                spu.write_out_mailbox(1);
                              })
        .cycles;
  };
  if (cycles(true) <= cycles(false)) return 2;
  const auto careless =
      celltrace::emulate(celltrace::lockstep(1), celltrace::spe_main(copy_main, 0), celltrace::to_ea(data));
  std::printf("%s", careless.report().c_str());
  return careless.ok() ? 3 : 0;
}
