#pragma once
// The common part of the tests of lexer and parser.

#include "frontend/syntax/parser.h"

#include <memory>
#include <string>

namespace rapid::test {

struct Parsed {
    std::unique_ptr<syntax::SyntaxTree> tree;
    diag::Sink sink;
    /// "RAP1201@3:5 RAP1202@9:1", in the order of the text
    std::string codes() const {
        std::string out;
        for (const diag::Diagnostic& d : sink.sorted()) {
            const LineColumn at = d.file->lineColumn(d.range.begin);
            if (!out.empty()) out += ' ';
            out += diag::codeName(d.code) + "@" + std::to_string(at.line) + ":" + std::to_string(at.column);
        }
        return out;
    }
    /// The diagnostics as people see them, for INFO.
    std::string shown() const {
        std::string out;
        for (const diag::Diagnostic& d : sink.sorted())
            out += renderText(d, false);
        return out;
    }
};

inline Parsed parseText(std::string text, bool declarations = false, std::string path = "test.modx") {
    Parsed result;
    syntax::ParseOptions options;
    options.declarations = declarations;
    auto source = std::make_shared<const SourceFile>(std::move(path), std::move(text));
    result.tree = syntax::parse(std::move(source), result.sink, options);
    return result;
}

/// A routine body in a module: the body begins in line 3.
inline std::string inProcedure(const std::string& body) {
    return "MODULE m\nPROC main()\n" + body + "\nENDPROC\nENDMODULE\n";
}

} // namespace rapid::test
