// Writing whole text files so that a reader, or an interrupted run, never sees half of one.
#pragma once

#include <filesystem>
#include <string_view>

namespace nsframe {

// Writes beside `path` and renames, so that an earlier file is replaced only by a complete one. Throws IoError.
void write_text_file(const std::filesystem::path& path, std::string_view text);

// Makes the folder and those above it. Throws IoError when something else is in the way or it is not allowed.
void make_folder(const std::filesystem::path& folder);

// Replaces `to` by `from`. Throws IoError.
void replace_file(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace nsframe
