#pragma once
// OutputGuard: what a command reads and what it writes, so that no output takes the place of an input, of a source
// file or of another output. To be asked before anything is written.

#include <string>
#include <sys/types.h>
#include <vector>

namespace rapid::config {

class OutputGuard {
  public:
    /// Takes in the standard output when it goes to a file.
    OutputGuard();

    /// A file that is read. `what`: as people call it ("the configuration"); "" for an input as such.
    void reads(const std::string& path, std::string what = {});
    /// A file that is to be written. `option`: "--trace". An empty path means no output.
    void writes(const std::string& path, std::string option);
    /// The same for an output that is a configuration: its name may say so.
    void writesConfiguration(const std::string& path, std::string option);

    /// Two names for one file count however they are written: relative, through links, hard links, in another case.
    /// Devices and pipes may be named as often as one likes.
    ///
    /// Returns the first conflict, for people, with its remedy; empty: there is none.
    [[nodiscard]] std::string conflict() const;

  private:
    struct File {
        std::string path, what;
        bool exists = false, ordinary = true;
        bool configuration = false; ///< it is to be one
        dev_t device = 0;
        ino_t node = 0;
        std::string canonical; ///< in lower case
    };
    static File fileOf(const std::string& path, std::string what);
    static bool same(const File& a, const File& b);

    std::vector<File> inputs_, outputs_;
    File standardOutput_;
};

} // namespace rapid::config
