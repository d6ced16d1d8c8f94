// libFuzzer target: any bytes go through lexer and parser, as a file and as declarations of built-ins. Must not crash
// or hang; the tree must be lossless, its nodes must lie within their parents, and errors must stay within bounds.
//
//   rapidc_fuzz_parser -dict=tests/fuzz/dictionaries/rapid.dict <own corpus folder> tests/fuzz/corpus/parser

#include "frontend/syntax/parser.h"
#include "frontend/syntax/tree_walk.h"

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

namespace {

using namespace rapid;

void require(bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

void checkNode(const syntax::SyntaxTree& tree, const syntax::Node& node) {
    require(node.last < tree.tokens.size(), "a node ends after the last token");
    syntax::forEachChild(node, [&](const syntax::Node& child) {
        if (child.first <= child.last)
            require(child.first >= node.first && child.last <= node.last, "a node lies outside its parent");
        checkNode(tree, child);
    });
}

void check(const char* name, const std::string& bytes, bool declarations) {
    auto source = std::make_shared<const SourceFile>(name, bytes);
    diag::Sink sink;
    syntax::ParseOptions options;
    options.declarations = declarations;
    const auto tree = syntax::parse(source, sink, options);
    require(syntax::printSource(*tree) == source->text(), "the tree does not give the source text back");
    require(sink.errorCount() <= 201, "too many errors are shown");
    for (const diag::Diagnostic& d : sink.sorted()) {
        require(d.range.begin <= d.range.end && d.range.end <= source->text().size(),
                "a place outside the text");
        renderText(d, false);
    }
    for (const syntax::ModuleDecl* module : tree->modules)
        checkNode(*tree, *module);
    syntax::printTree(*tree);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    check("fuzz.modx", bytes, false);
    check("fuzz.mod", bytes, true);
    return 0;
}
