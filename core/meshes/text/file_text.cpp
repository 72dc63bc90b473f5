#include "core/meshes/text/file_text.h"

#include <cstdint>
#include <fstream>
#include <system_error>

#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

namespace {

/// How files begin that a download, an archive or a version control system leaves in the place of others.
struct Disguise {
  std::string_view begin, is, expected;
};
using namespace std::string_view_literals;
constexpr std::string_view unpacked = "the file in it: unpack it first", itself = "the file itself";
constexpr Disguise disguises[] = {
    {"PK\x03\x04", "this is a ZIP archive", unpacked},
    {"\x1f\x8b\x08", "this is compressed by gzip", unpacked},
    {"BZh91AY&SY", "this is compressed by bzip2", unpacked},
    {"\xfd"
     "7zXZ\0"sv,
     "this is compressed by xz", unpacked},
    {"\x28\xb5\x2f\xfd", "this is compressed by Zstandard", unpacked},
    {"7z\xbc\xaf\x27\x1c", "this is a 7-Zip archive", unpacked},
    {"Rar!\x1a\x07", "this is a RAR archive", unpacked},
    {"version https://git-lfs", "this is a pointer of Git LFS", "the file itself, which 'git lfs pull' fetches"},
    {"/annex/objects/", "this is a pointer of git-annex", "the file itself, which 'git annex get' fetches"},
    {"<!DOCTYPE html", "this is a page of HTML", itself},
    {"<!doctype html", "this is a page of HTML", itself},
    {"<html", "this is a page of HTML", itself},
    {"\xff\xfe", "this is text in UTF-16", "ASCII or UTF-8"},
    {"\xfe\xff", "this is text in UTF-16", "ASCII or UTF-8"},
};

}  // namespace

std::string file_text(const fs::path& path, std::string_view wanted) {
  const std::string file = path.string();
  std::error_code error;
  if (!is_there(path)) fail_at(file, 0, "there is no such file", wanted);
  if (is_folder(path)) fail_at(file, 0, "this is a directory", wanted);
  if (!fs::is_regular_file(path, error)) fail_at(file, 0, "this is not a regular file", wanted);
  std::ifstream in(path, std::ios::binary);
  const auto size = fs::file_size(path, error);
  if (!in || error) fail_at(file, 0, "the file cannot be opened", "a file that may be read");
  std::string text(size, '\0');
  in.read(text.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(in.gcount()) != size) fail_at(file, 0, "reading stopped early", "a readable file");
  if (text.empty()) fail_at(file, 1, "the file is empty", wanted);
  for (const Disguise& one : disguises)
    if (text.starts_with(one.begin)) fail_at(file, 0, one.is, one.expected);
  return text;
}

}  // namespace dartboard
