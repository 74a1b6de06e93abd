#include "output/files.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "base/errors.hpp"

namespace nsframe {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw IoError(fmt::format("cannot write '{}': {}", path.string(), std::strerror(error)));
}

}  // namespace

void write_text_file(const std::filesystem::path& path, std::string_view text) {
  std::filesystem::path partial = path;
  partial += ".partial";
  std::unique_ptr<std::FILE, CloseFile> file(std::fopen(partial.c_str(), "wb"));
  if (!file) fail(path, errno);
  const bool written = std::fwrite(text.data(), 1, text.size(), file.get()) == text.size();
  const int write_error = errno;
  // The last bytes may fail only here (a full disk), so the result of closing counts.
  const bool closed = std::fclose(file.release()) == 0;
  if (!written || !closed) {
    const int error = written ? errno : write_error;
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    fail(path, error);
  }
  replace_file(partial, path);
}

void make_folder(const std::filesystem::path& folder) {
  if (folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) {
    throw IoError(fmt::format("cannot make the folder '{}': {}", folder.string(),
                              error ? error.message() : "a file of that name exists"));
  }
}

void replace_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  std::filesystem::rename(from, to, error);
  if (error) throw IoError(fmt::format("cannot write '{}': {}", to.string(), error.message()));
}

}  // namespace nsframe
