#include "cli/compare_command.hpp"

#include "celltrace/image.hpp"

#include <iostream>

namespace celltrace::cli {

int run_compare(const CompareRequest& request) {
  const Image a = load_image(request.a);
  const Image b = load_image(request.b);
  const Comparison comparison = compare_images(a, b);
  if (!request.difference.empty()) save_image(request.difference, difference_image(a, b));

  std::cout << (request.json ? to_json(comparison) : to_text(comparison)) << std::endl;
  const bool psnr_reached = !request.min_psnr || comparison.psnr >= *request.min_psnr;
  const bool ssim_reached = !request.min_ssim || comparison.worst_ssim >= *request.min_ssim;
  return psnr_reached && ssim_reached ? 0 : 1;
}

} // namespace celltrace::cli
