#pragma once
// The common part of the fuzz targets.

#include "frontend/diag/diagnostic.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace rapid::fuzz {

/// Ends the process when a promise is broken, so that libFuzzer keeps the input.
inline void require(bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

inline std::string bytesOf(const uint8_t* data, size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// Every diagnostic lies within its file and can be shown in all forms.
inline void checkDiagnostics(const diag::Sink& sink) {
    const auto sorted = sink.sorted();
    for (const diag::Diagnostic& d : sorted) {
        if (d.file)
            require(d.range.begin <= d.range.end && d.range.end <= d.file->text().size(),
                    "a place outside the text");
        require(!d.message.empty(), "a diagnostic without a text");
        renderText(d, false);
    }
    require(!renderJson(sorted).empty() && !renderSarif(sorted).empty(),
            "diagnostics without a form for programs");
}

} // namespace rapid::fuzz
