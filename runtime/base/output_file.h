#pragma once
// OutputFile: a file that a run leaves (trace, signals, events). Whatever is lost of it is reported, and known at the end.

#include <cstdio>
#include <string>
#include <string_view>

namespace rt {

/// A text file written from beginning to end.
class OutputFile {
  public:
    OutputFile() = default;
    ~OutputFile() { close(); }
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// False with a reason when the file cannot be made. A pipe that no program reads is given up after some seconds.
    bool open(const std::string& path, std::string& error);
    bool isOpen() const { return file_ != nullptr; }
    /// The first part that is lost is reported on stderr.
    void write(std::string_view text);
    void flush();
    /// False when something could not be written (disk full), here or before.
    bool close();

  private:
    void fail();
    std::string path_;
    std::FILE* file_ = nullptr;
    bool failed_ = false;
};

/// Writes a whole file. Returns what went wrong, for people ("cannot write x.svg: No space left on device"); empty:
/// success.
[[nodiscard]] std::string writeWhole(const std::string& path, std::string_view text);

} // namespace rt
