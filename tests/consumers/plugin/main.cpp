// A program that knows nothing of celltrace, and loads a plugin while it runs.
#include <cstdio>
#include <dlfcn.h>

int main() {
  void* const plugin = dlopen(PLUGIN, RTLD_NOW);
  if (plugin == nullptr) {
    std::printf("%s\n", dlerror());
    return 1;
  }
  const auto red = reinterpret_cast<int (*)(const char*)>(dlsym(plugin, "red_of_sphere"));
  if (red == nullptr) return 2;
  std::printf("red %d and %d\n", red("native"), red("cell_emu"));
  return red("native") > 100 && red("native") == red("cell_emu") ? 0 : 3;
}
