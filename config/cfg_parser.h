#pragma once
// Reader of ABB's configuration text files (EIO, SYS, MOC, SIO, PROC, MMC ...): domain header, sections of
// types, instances of attributes. Generic and tolerant: every domain is kept as read; what a domain means is
// decided elsewhere.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rapid::config {

struct CfgAttribute {
    std::string name; ///< as written, without the dash
    std::vector<std::string>
        values; ///< comma lists split; empty: given by presence alone (a boolean that is TRUE)
    bool quoted = false;
    uint32_t line = 0;

    /// First value, "" when there is none.
    const std::string& text() const;
};

struct CfgInstance {
    std::vector<CfgAttribute> attributes;
    uint32_t line = 0;

    /// Names compare without regard to case; null when absent.
    const CfgAttribute* find(std::string_view name) const;
    std::string text(std::string_view name, std::string_view fallback = {}) const;
    /// Absent: false. By presence alone, TRUE, YES, 1: true. FALSE, NO, 0: false.
    bool flag(std::string_view name) const;
    /// True when present and a number; `value` keeps its default otherwise.
    bool number(std::string_view name, double& value) const;
};

struct CfgSection {
    std::string type;     ///< "EIO_SIGNAL"
    std::string baseType; ///< of a derived type (MMC_MC1 = MMC_PALETTE), else ""
    std::vector<CfgInstance> instances;
    uint32_t line = 0;
};

struct CfgFile {
    std::string name;    ///< file name for messages
    std::string domain;  ///< "EIO"
    std::string version; ///< rest of the first line: "CFG_1.0:7:0::"
    std::vector<CfgSection> sections;

    /// All sections of this type, in order (a type may come more than once).
    std::vector<const CfgSection*> find(std::string_view type) const;
};

struct CfgProblem {
    std::string file;
    uint32_t line = 0; ///< from 1
    std::string message;
    bool warning = false;     ///< what it concerns is left out, the rest works (a signal of an add-in, say)
    std::size_t more = 0;     ///< not one problem, but the number of those that are not listed
    std::string text() const; ///< "EIO.cfg:12: ..."
};

/// After so many problems in a file one more says how many others there are.
inline constexpr std::size_t kMaxCfgProblems = 50;

/// The same for problems that several readers have found: of each file the first kMaxCfgProblems, and one that counts
/// the rest.
void limitProblems(std::vector<CfgProblem>& problems);

/// Reads the text of one file. ISO 8859-1 is turned into UTF-8 when the text is not UTF-8 already. Problems
/// (all of them, up to kMaxCfgProblems) are appended; what could be read is returned all the same.
CfgFile parseCfg(std::string_view text, std::string name, std::vector<CfgProblem>& problems);
/// The same from disk; an unreadable file is a problem with line 0.
CfgFile readCfg(const std::string& path, std::vector<CfgProblem>& problems);

} // namespace rapid::config
