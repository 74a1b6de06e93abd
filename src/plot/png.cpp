// SVG to PNG by librsvg and cairo.
#include <fmt/format.h>
#include <librsvg/rsvg.h>

#include <cmath>
#include <memory>

#include "base/errors.hpp"
#include "plot/picture.hpp"

namespace nsframe {
namespace {

struct Release {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
  void operator()(GError* error) const { g_error_free(error); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};

[[noreturn]] void fail(const char* why) { throw IoError(fmt::format("error: cannot make a PNG: {}", why)); }

[[noreturn]] void fail(GError* error) {
  const std::unique_ptr<GError, Release> owned(error);
  fail(owned ? owned->message : "librsvg gives no reason");
}

cairo_status_t append(void* text, const unsigned char* data, unsigned size) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string png_of(const std::string& svg) {
  GError* error = nullptr;
  const std::unique_ptr<RsvgHandle, Release> handle(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error));
  if (!handle) fail(error);
  RsvgRectangle page{0, 0, 0, 0};
  if (!rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &page.width, &page.height)) fail("the SVG has no size");
  const std::unique_ptr<cairo_surface_t, Release> surface(cairo_image_surface_create(
      CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(page.width)), static_cast<int>(std::lround(page.height))));
  const std::unique_ptr<cairo_t, Release> context(cairo_create(surface.get()));
  if (!rsvg_handle_render_document(handle.get(), context.get(), &page, &error)) fail(error);
  std::string bytes;
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS) fail(cairo_status_to_string(status));
  return bytes;
}

}  // namespace nsframe
