// Files and modules (manual 1.1.3), and the entry point of the parser.

#include "frontend/syntax/parser_impl.h"
#include "frontend/syntax/tree_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace rapid::syntax {

using diag::Code;

namespace {

constexpr TokenSet kDeclStart = {
    TokenKind::KwVar,    TokenKind::KwPers,   TokenKind::KwConst,  TokenKind::KwLocal, TokenKind::KwProc,
    TokenKind::KwFunc,   TokenKind::KwTrap,   TokenKind::KwRecord, TokenKind::KwAlias, TokenKind::KwModule,
    TokenKind::PlaceTdn, TokenKind::PlaceDdn, TokenKind::PlaceRdn};

uint8_t attributeOf(TokenKind kind) {
    switch (kind) {
    case TokenKind::KwSysmodule: return kAttrSysmodule;
    case TokenKind::KwNoview: return kAttrNoview;
    case TokenKind::KwNostepin: return kAttrNostepin;
    case TokenKind::KwViewonly: return kAttrViewonly;
    case TokenKind::KwReadonly: return kAttrReadonly;
    default: return 0;
    }
}

/// Mistakes of the file as a whole. Returns false when there is no text to parse.
bool checkEncoding(const std::shared_ptr<const SourceFile>& source, diag::Sink& sink) {
    const std::string_view text = source->text();
    if (source->isBinary()) {
        // FF FE and FE FF, the marks of UTF-16, were read as Latin-1.
        const bool utf16 = text.starts_with("\xC3\xBF\xC3\xBE") || text.starts_with("\xC3\xBE\xC3\xBF");
        if (source->isEncrypted()) {
            sink.report(Code::EncryptedModule, source, {0, 0}, {source->path()});
            return false;
        }
        sink.report(utf16 ? Code::Utf16File : Code::BinaryFile, source, {0, 0});
        return false;
    }
    if (source->badUtf8Offset() >= 0) {
        const auto at = static_cast<uint32_t>(source->badUtf8Offset());
        // The byte stands there as the two bytes of its Latin-1 character.
        const unsigned byte = (static_cast<unsigned char>(text[at]) & 3u) << 6 |
                              (static_cast<unsigned char>(text[at + 1]) & 0x3Fu);
        sink.report(Code::BadUtf8, source, {at, at + 2}, {fmt::format("0x{:02X}", byte)});
    } else if (source->encoding() == Encoding::Utf8Bom) {
        sink.report(Code::ByteOrderMark, source, {0, 0});
    }
    return true;
}

} // namespace

Parser::Parser(SyntaxTree& tree, diag::Sink& sink, const ParseOptions& options)
    : tree_(tree), sink_(sink), options_(options), tokens_(tree.tokens.data()),
      last_(static_cast<TokenIndex>(tree.tokens.size()) - 1) {}

void Parser::parseFile(const LexResult& lexed) {
    lexed_ = &lexed;
    if (!lexed.hasModule && startsMisspeltModule()) {
        reportLexErrors(lexed);
        accept(K::FileHeader);
        retag(pos_, pos_, K::KwModule);
    } else if (!lexed.hasModule) { // not RAPID: one report, whatever its characters are
        const TokenIndex first = kind() == K::FileHeader ? 1 : 0;
        if (kindAt(first) == K::EndOfFile) {
            report(Code::NoModule, first);
        } else {
            report(Code::TextOutsideModule, first, {describe(first)});
        }
        return;
    } else {
        reportLexErrors(lexed);
        readLaterWordsAsNames();
        accept(K::FileHeader);
    }
    for (;;) {
        warnOutsideComment(pos_);
        if (kind() == K::EndOfFile) break;
        if (accept(K::FileHeader)) continue;
        if (kind() == K::KwModule) {
            parseModule();
        } else if (kind() == K::Semicolon && pos_ > 0 && kindAt(pos_ - 1) == K::KwEndmodule) {
            skipStraySemicolons();
        } else {
            skipOutsideModule();
        }
    }
    reportBrokenStrings();
    if (wentBackTo_ == 0) return;
    for (ModuleDecl* module : tree_.modules)
        cutOff(*module);
}

/// After going back: what was read as the end of an unfinished line but stands below it is no part of it.
void Parser::cutOff(Node& node) {
    if (node.kind == NodeKind::Aggregate && as<AggregateExpr>(node).isPlain()) return;
    if (node.kind == NodeKind::Component && as<ComponentExpr>(node).name > node.last)
        as<ComponentExpr>(node).name = kNoToken;
    forEachChild(node, [&](const Node& each) {
        Node& child = const_cast<Node&>(each); // of the tree that is being made
        if (child.first <= child.last && child.last > node.last) {
            if (child.first > node.last) {
                if (isExpr(child.kind)) child.kind = NodeKind::ErrorExpr;
                if (child.kind == NodeKind::Argument) as<Argument>(child).name = kNoToken;
                child.first = node.last + 1;
            }
            child.last = node.last;
        }
        cutOff(child);
    });
}

/// MODUEL name
bool Parser::startsMisspeltModule() const {
    const TokenIndex first = kind() == K::FileHeader ? 1 : 0;
    return meant(first, K::KwModule) && kindAt(first + 1) == K::Identifier && !startsLine(first + 1);
}

/// Comments belong inside of modules (manual 1.1.2); one report a file.
void Parser::warnOutsideComment(TokenIndex next) {
    if (outsideCommentShown_) return;
    const std::string_view text = tree_.source->text();
    const uint32_t from = next == 0 ? 0 : tree_.range(next - 1).end;
    const uint32_t to =
        kindAt(next) == K::EndOfFile ? static_cast<uint32_t>(text.size()) : tokens_[next].offset;
    const size_t comment = text.substr(0, to).find('!', from);
    if (comment == std::string_view::npos) return;
    outsideCommentShown_ = true;
    const size_t end = std::min<size_t>(text.find_first_of("\r\n", comment), text.size());
    reportAt(Code::CommentOutsideModule, {static_cast<uint32_t>(comment), static_cast<uint32_t>(end)});
}

/// The second line of a string that was broken in two: its closing '"' looks like the beginning of another string.
bool Parser::endsBrokenString(const LexError& error, const LexError* before) const {
    if (error.code != Code::UnterminatedString || !before || before->code != Code::UnterminatedString)
        return false;
    const std::string_view text = tree_.source->text();
    const uint32_t line = tree_.source->lineColumn(error.range.begin).line;
    if (tree_.source->lineColumn(before->range.begin).line + 1 != line) return false;
    const size_t next = text.find_first_not_of(" \t", error.range.begin + 1);
    constexpr std::string_view kAfterString = ";,)]\\+\r\n";
    return next == std::string_view::npos || kAfterString.find(text[next]) != std::string_view::npos;
}

/// A backslash in a string that does not end: what is wrong there is the missing '"'. Both stand near in the list.
bool Parser::isInBrokenString(const LexResult& lexed, const LexError& escape) {
    constexpr std::ptrdiff_t kNear = 64;
    const LexError *begin = lexed.errors.data(), *end = begin + lexed.errors.size();
    return std::any_of(std::max(begin, &escape - std::min(kNear, &escape - begin)),
                       &escape + std::min(kNear, end - &escape), [&](const LexError& e) {
                           return e.code == Code::UnterminatedString && e.range.begin <= escape.range.begin &&
                                  escape.range.end <= e.range.end;
                       });
}

void Parser::reportLexErrors(const LexResult& lexed) {
    const LexError* before = nullptr;
    for (const LexError& error : lexed.errors) {
        badNumbers_ |= error.code == Code::BadNumber;
        if (error.code == Code::BadNumber) continue; // said where the number is read
        if (error.code == Code::ForeignSpelling && error.args[0] == "==") continue; // so is what it means
        if (error.code == Code::BadStringEscape && isInBrokenString(lexed, error)) continue;
        const LexError* last = std::exchange(before, &error);
        if (endsBrokenString(error, last)) { // what stands between the lines is no code
            const Token* between =
                std::lower_bound(tokens_, tokens_ + last_, last->range.end,
                                 [](const Token& token, uint32_t offset) { return token.offset < offset; });
            for (; between < tokens_ + last_ && between->offset < error.range.end; ++between)
                readAs(static_cast<TokenIndex>(between - tokens_), K::Error);
            before = nullptr;
            continue;
        }
        if (error.code == Code::UnterminatedString) {
            ++errors_;
            brokenStrings_.push_back({error.range, {}});
            continue;
        }
        lexErrors_.push_back(error.range.begin);
        if (++errors_ <= kMaxErrorsPerFile) {
            diag::Diagnostic& d = sink_.report(error.code, tree_.source, error.range, error.args);
            if (error.code == Code::BadStringEscape) fixEscapes(d);
            if (error.fix) d.fix(error.range, *error.fix);
        } else if (errors_ == kMaxErrorsPerFile + 1) {
            sink_.report(Code::TooManyErrors, tree_.source, error.range, {"errors"});
        }
    }
}

/// At last: what could not be read before such a string tells where a quote may be missing or one too many.
void Parser::reportBrokenStrings() {
    for (const BrokenString& string : brokenStrings_) {
        diag::Diagnostic& d = sink_.report(Code::UnterminatedString, tree_.source, string.range);
        if (string.doubtful.end != 0)
            d.notes.push_back(
                {tree_.source, string.doubtful,
                 "this stands between two strings: a '\"' may be missing or one too many before it"});
    }
}

/// Doubles each backslash of the string that stands for itself. Not certain beside character codes: a path may look
/// like one (`"C:\temp\data"`).
void Parser::fixEscapes(diag::Diagnostic& diagnostic) const {
    const std::string_view text = tree_.source->text();
    const auto isHex = [&](size_t at) {
        return at < text.size() && std::isxdigit(static_cast<unsigned char>(text[at]));
    };
    diag::Diagnostic::Fix all{"write each '\\' twice", {}};
    for (auto at = diagnostic.range.begin; at < text.size() && text[at] != '\n' && text[at] != '\r'; ++at) {
        const bool last = at + 1 == text.size();
        if (text[at] == '"') {
            if (last || text[at + 1] != '"') break;
            ++at;
        } else if (text[at] == '\\') {
            if (!last && text[at + 1] == '\\')
                ++at;
            else if (isHex(at + 1) && isHex(at + 2))
                all.certain = false;
            else
                all.edits.push_back({{at, at}, "\\"});
        }
    }
    diagnostic.fixes.push_back(std::move(all));
}

Expr* Parser::parseWholeExpression(const LexResult& lexed) {
    reportLexErrors(lexed);
    Expr* result = parseExpr();
    if (kind() != K::EndOfFile && !panic_) unexpected("the end of the expression");
    reportBrokenStrings();
    return result;
}

/// Anything between modules but comments is reported once.
void Parser::skipOutsideModule() {
    if (kind() == K::KwEndmodule && openModules_ > 0) { // of a module around the last one, which is reported
        --openModules_;
        take();
        return;
    }
    if (kind() != K::Error) report(Code::TextOutsideModule, pos_, {describe(pos_)});
    do
        take();
    while (kind() != K::EndOfFile && !(kind() == K::KwModule && startsLine(pos_)));
}

/// `ENDPROC;` and the like: harmless, but no declaration.
void Parser::skipStraySemicolons() {
    diag::Diagnostic* diagnostic = report(Code::StraySemicolon, pos_, {describe(pos_ - 1)});
    const uint32_t from = tree_.range(pos_).begin;
    while (accept(K::Semicolon)) {
    }
    if (diagnostic) diagnostic->fix({from, tree_.range(pos_ - 1).end}, "");
}

void Parser::parseModule() {
    auto* node = tree_.arena.make<ModuleDecl>();
    node->kind = NodeKind::Module;
    node->first = pos_;
    panic_ = false;
    quietOutside_ = false;
    const TokenIndex opening = take();
    skipSecond(opening);
    node->name = expectName();
    checkNameLength(node->name);
    if (!panic_ && kind() == K::LeftParen) parseModuleAttributes(node);
    if (!panic_ && !startsDecl(pos_) && !startsLine(pos_) && kind() != K::KwEndmodule &&
        kind() != K::EndOfFile && kind() != K::Semicolon)
        unexpected("'(' or a declaration");
    if (panic_) skipToDecl();
    parseModuleDecls(node);
    if (!accept(K::KwEndmodule)) {
        ++openModules_;
        if (isNewsHere())
            note(report(Code::MissingBlockEnd, pos_, {describe(pos_), "ENDMODULE"}), opening,
                 "MODULE begins here");
    }
    tree_.modules.push_back(finish(node));
}

void Parser::parseModuleAttributes(ModuleDecl* module) {
    const TokenIndex opening = take();
    std::vector<TokenIndex> seen;
    const TokenIndex first = pos_;
    const size_t errorsBefore = errors_;
    do {
        if (attributeOf(kind())) {
            addAttribute(module, pos_, seen);
            take();
        } else if (kind() == K::Identifier || isKeyword(kind())) {
            report(Code::UnknownModuleAttribute, pos_, {std::string(textOf(pos_))});
            take();
        } else {
            unexpected("a module attribute");
        }
    } while (!panic_ && accept(K::Comma));
    if (errors_ == errorsBefore + 1 && lastOrder_ && !panic_) fixAttributeOrder(first, seen);
    lastOrder_ = nullptr;
    expectClosing(K::RightParen, opening, true);
    module->attributeTokens = tree_.arena.copy(seen);
}

/// Order and combination of the attributes (manual 1.1.3).
void Parser::addAttribute(ModuleDecl* module, TokenIndex token, std::vector<TokenIndex>& seen) {
    const uint8_t attribute = attributeOf(kindAt(token));
    constexpr uint8_t kBesideNoview = kAttrSysmodule | kAttrNoview;
    const uint8_t all = module->attributes | attribute;
    if (module->attributes & attribute) {
        fix(report(Code::DuplicateModuleAttribute, token, {describe(token)}),
            {tree_.range(token - 2).end, tree_.range(token).end}, "");
    } else if ((all & kAttrNoview) && (all & ~kBesideNoview)) {
        const TokenIndex other = attribute == kAttrNoview ? seen.back() : token;
        if (!(module->attributes & kAttrNoview) || !(module->attributes & ~kBesideNoview))
            report(Code::ModuleAttributeConflict, token, {describe(other)});
    } else if (attribute < module->attributes) {
        lastOrder_ = report(Code::ModuleAttributeOrder, token, {describe(token), describe(seen.back())});
    }
    module->attributes = all;
    seen.push_back(token);
}

/// The same words in the order of the grammar.
void Parser::fixAttributeOrder(TokenIndex first, std::vector<TokenIndex> words) {
    std::sort(words.begin(), words.end(),
              [&](TokenIndex a, TokenIndex b) { return attributeOf(kindAt(a)) < attributeOf(kindAt(b)); });
    std::string sorted;
    for (const TokenIndex word : words)
        sorted += (sorted.empty() ? "" : ",") + std::string(textOf(word));
    fix(lastOrder_, {tree_.range(first).begin, tree_.range(pos_ - 1).end}, sorted);
}

bool Parser::startsDecl(TokenIndex i) const {
    return kDeclStart.has(kindAt(i)) || isTaskDirective(i);
}

void Parser::parseModuleDecls(ModuleDecl* module) {
    const size_t mark = decls_.size();
    while (kind() != K::KwEndmodule && kind() != K::KwModule && kind() != K::EndOfFile) {
        if (kind() == K::Identifier && !quietOutside_ && (retagDecl() || takesRunTogether())) continue;
        if (kind() == K::RightBrace && peek() == K::EndOfFile && !quietOutside_) {
            retag(pos_, pos_, K::KwEndmodule);
            break;
        }
        if (retagLastEnd()) break;
        const TokenIndex before = pos_;
        if (kind() == K::Semicolon && !quietOutside_) {
            skipStraySemicolons();
            continue;
        }
        if (Decl* decl = parseModuleDecl()) decls_.push_back(decl);
        while (Decl* decl = parseMoreNames())
            decls_.push_back(decl);
        panic_ = false;
        if (pos_ == before) take();
    }
    module->decls = drain(decls_, mark);
}

Decl* Parser::parseModuleDecl() {
    const TokenIndex first = pos_;
    switch (kind()) {
    case K::KwVar:
    case K::KwPers:
    case K::KwConst: return parseModuleData(ScopeWord::None, first);
    case K::KwLocal: return parseScopedDecl();
    case K::KwProc:
    case K::KwFunc:
    case K::KwTrap: quietOutside_ = false; return parseRoutine(false, first);
    case K::KwRecord: return parseRecord(false, first);
    case K::KwAlias: return parseAlias(false, first);
    case K::PlaceTdn:
    case K::PlaceDdn:
    case K::PlaceRdn: {
        auto* node = make<PlaceholderDecl>(NodeKind::PlaceholderDecl);
        take();
        return finish(node);
    }
    default: break;
    }
    if (isTaskDirective(pos_)) {
        take();
        return parseModuleData(ScopeWord::Task, first);
    }
    if (isContextual(pos_, "TASK") && (kDeclStart.has(peek()) && !isPlaceholder(peek())))
        return parseTaskDecl();
    if (isWordlessData() && !quietOutside_) return parseWordlessData();
    return parseUnknownDecl();
}

/// TASK before what cannot take it: left out, or with LOCAL.
Decl* Parser::parseTaskDecl() {
    const TokenIndex first = pos_;
    const SourceRange word{tree_.range(pos_).begin, tree_.range(pos_ + 1).begin};
    if (peek() == K::KwLocal) {
        report(Code::ScopeConflict, pos_);
    } else {
        fix(report(Code::TaskDirective, pos_, {describe(pos_ + 1)}), word, "");
    }
    take();
    if (Decl* decl = parseModuleDecl()) return decl;
    auto* node = make<PlaceholderDecl>(NodeKind::ErrorDecl);
    node->first = first;
    return finish(node);
}

Decl* Parser::parseScopedDecl() {
    const TokenIndex first = take();
    switch (kind()) {
    case K::KwVar:
    case K::KwPers:
    case K::KwConst: return parseModuleData(ScopeWord::Local, first);
    case K::KwProc:
    case K::KwFunc:
    case K::KwTrap: quietOutside_ = false; return parseRoutine(true, first);
    case K::KwRecord: return parseRecord(true, first);
    case K::KwAlias: return parseAlias(true, first);
    default: break;
    }
    if (isTaskDirective(pos_)) {
        report(Code::ScopeConflict, pos_);
        take();
        return parseModuleData(ScopeWord::Task, first);
    }
    unexpected("a declaration after LOCAL");
    quietOutside_ = true;
    skipToDecl();
    auto* node = make<PlaceholderDecl>(NodeKind::ErrorDecl);
    node->first = first;
    return finish(node);
}

/// What is no declaration: instructions after an ENDPROC too many, misspelt words. One report up to the next routine.
Decl* Parser::parseUnknownDecl() {
    auto* node = make<PlaceholderDecl>(NodeKind::ErrorDecl);
    constexpr TokenSet kEnds = {K::KwEndproc, K::KwEndfunc, K::KwEndtrap};
    if (kind() != K::Error && !quietOutside_) {
        if (kEnds.has(kind())) {
            report(Code::StrayKeyword, pos_, {describe(pos_), std::string(tokenText(kind()).substr(3))});
        } else if (kind() == K::KwEndrecord) {
            report(Code::StrayKeyword, pos_, {describe(pos_), "RECORD"});
        } else {
            diag::Diagnostic* diagnostic = report(Code::InstructionOutsideRoutine, pos_, {describe(pos_)});
            if (kind() == K::Semicolon) fix(diagnostic, tree_.range(pos_), "");
        }
    }
    if (kind() != K::Semicolon) quietOutside_ = true;
    take();
    skipToDecl();
    return finish(node);
}

/// To the next word at the beginning of a line, or after a semicolon or END word, that begins a declaration.
void Parser::skipToDecl() {
    panic_ = false;
    for (; kind() != K::EndOfFile && kind() != K::KwEndmodule; take()) {
        if (!startsDecl(pos_)) continue;
        const K before = pos_ > 0 ? tokens_[pos_ - 1].kind : K::Semicolon;
        if (startsLine(pos_) || before == K::Semicolon || before == K::RightParen || isKeyword(before))
            return;
    }
}

namespace {

/// The tree with its tokens; a binary file has none but the end.
std::unique_ptr<SyntaxTree> makeTree(std::shared_ptr<const SourceFile> source, diag::Sink& sink,
                                     const ParseOptions& options, LexResult& lexed) {
    auto tree = std::make_unique<SyntaxTree>();
    tree->source = std::move(source);
    const std::string_view text = tree->source->text();
    if (checkEncoding(tree->source, sink)) {
        if (!options.earlier || !relex(*tree, *options.earlier, lexed)) {
            lexed = lex(text, options.wholeAggregates);
            tree->tokens = tree->arena.copy(lexed.tokens);
            tree->shapes = std::move(lexed.shapes);
        }
        tree->retagged = !lexed.errors.empty();
    } else {
        tree->retagged = true;
        tree->tokens = tree->arena.makeArray<Token>(1);
        tree->tokens[0].offset = static_cast<uint32_t>(text.size());
    }
    return tree;
}

/// What is reported here leaves open how the line was meant: there is no certain edit, and the text is not just too long or
/// in the wrong place.
bool leavesOpen(const diag::Diagnostic& d) {
    constexpr Code kClear[] = {Code::StringTooLong, Code::NameTooLong, Code::NumberTooLarge,
                               Code::DeclarationAfterInstruction};
    const bool certain =
        std::any_of(d.fixes.begin(), d.fixes.end(), [](const auto& fix) { return fix.certain; });
    const std::string_view text = d.file->text();
    if (d.code == Code::MissingBlockEnd && !equalsNoCase(text.substr(d.range.begin, 3), "END")) return false;
    return d.severity == diag::Severity::Error && !certain &&
           std::find(std::begin(kClear), std::end(kClear), d.code) == std::end(kClear);
}

void noteUnclearLines(SyntaxTree& tree, std::span<const diag::Diagnostic> reported) {
    const std::string_view text = tree.source->text();
    for (const diag::Diagnostic& d : reported) {
        if (d.file != tree.source || !leavesOpen(d)) continue;
        uint32_t begin = d.range.begin;
        while (begin > 0 && d.range.begin - begin < SyntaxTree::kUnclearReach && text[begin - 1] != '\n' &&
               text[begin - 1] != '\r')
            --begin;
        tree.unclearLines.push_back(begin);
    }
    std::sort(tree.unclearLines.begin(), tree.unclearLines.end());
}

std::unique_ptr<SyntaxTree> parseOnce(std::shared_ptr<const SourceFile> source, diag::Sink& sink,
                                      const ParseOptions& options) {
    LexResult lexed;
    const size_t before = sink.all().size();
    auto tree = makeTree(std::move(source), sink, options, lexed);
    if (!tree->source->isBinary()) Parser(*tree, sink, options).parseFile(lexed);
    noteUnclearLines(*tree, std::span(sink.all()).subspan(before));
    return tree;
}

} // namespace

std::unique_ptr<SyntaxTree> parse(std::shared_ptr<const SourceFile> source, diag::Sink& sink,
                                  const ParseOptions& options) {
    if (options.wholeAggregates) {
        diag::Sink own;
        ParseOptions all = options;
        all.wholeAggregates = false; // what is said of mistakes needs all tokens
        auto tree = parseOnce(source, own, options);
        if (own.hasErrors()) return parseOnce(std::move(source), sink, all);
        sink.add(own.all());
        return tree;
    }
    return parseOnce(std::move(source), sink, options);
}

ParsedExpr parseExpression(std::shared_ptr<const SourceFile> source, diag::Sink& sink) {
    LexResult lexed;
    ParsedExpr result;
    const ParseOptions options;
    result.tree = makeTree(std::move(source), sink, options, lexed);
    result.expr = Parser(*result.tree, sink, options).parseWholeExpression(lexed);
    return result;
}

} // namespace rapid::syntax
