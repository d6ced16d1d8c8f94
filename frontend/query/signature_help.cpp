#include "frontend/query/signature_help.h"

#include "frontend/query/describe.h"
#include "frontend/query/name_walk.h"
#include "frontend/query/optional_names.h"
#include "frontend/sema/names.h"

#include <algorithm>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

/// The beginning of the literal that the offset is in or touches: what is within it says nothing about the call.
uint32_t beforeLiteral(const FileView& file, uint32_t offset) {
    const TokenIndex token = tokenBefore(file, offset);
    if (token == kNoToken) return offset;
    const TokenKind kind = file.tree->tokens[token].kind;
    const SourceRange range = file.tree->range(token);
    const bool literal =
        kind == TokenKind::StringLiteral || kind == TokenKind::NumLiteral || kind == TokenKind::Error;
    const bool inside = kind == TokenKind::StringLiteral ? offset < range.end : offset <= range.end;
    return literal && inside ? range.begin : offset;
}

/// The parameter whose name begins with the letters after `\`, or the next one.
int parameterNamed(const CallContext& call, std::string_view letters) {
    const std::vector<const DataSymbol*> choices = optionalChoices(call);
    const std::string wanted = foldName(letters);
    const DataSymbol* found = choices.empty() ? nullptr : choices.front();
    for (const DataSymbol* param : choices)
        if (foldName(param->name).starts_with(wanted)) {
            found = param;
            break;
        }
    const auto& params = call.routine->params;
    for (size_t i = 0; i < params.size(); ++i)
        if (params[i] == found) return static_cast<int>(i);
    return -1;
}

/// The parameter that the checker has found for the argument at the offset: one of several that exclude each other, perhaps.
int boundParameter(const FileView& file, const CallContext& call, uint32_t offset) {
    for (const Node* node : nodesAt(file, offset)) {
        const BoundCall* bound = boundCallOf(file, *node);
        if (!bound || bound->routine != call.routine) continue;
        for (const BoundArg& arg : bound->args) {
            if (!arg.param || !arg.argument || arg.argument->first == kNoToken) continue;
            const SourceRange range = file.tree->range(*arg.argument);
            if (offset < range.begin || offset > range.end) continue;
            for (size_t i = 0; i < call.routine->params.size(); ++i)
                if (call.routine->params[i] == arg.param) return static_cast<int>(i);
        }
    }
    return -1;
}

} // namespace

std::optional<SignatureHelp> signatureHelpAt(const Snapshot& snapshot, const FileView& file,
                                             uint32_t offset) {
    offset = std::min(offset, static_cast<uint32_t>(file.text().size()));
    if (isInComment(file, offset)) return std::nullopt;
    offset = beforeLiteral(file, offset);
    const Scope scope(snapshot, file, offset);
    const Cursor cursor = cursorAt(scope, offset);
    if (!cursor.call || !cursor.call->routine) return std::nullopt;
    const CallContext& call = *cursor.call;
    SignatureHelp help;
    help.name = file.tree->range(call.name);
    RoutineLabel label = routineLabel(*call.routine);
    help.label = std::move(label.text);
    help.documentation = documentationOf(snapshot, *call.routine);
    for (const ParameterLabel& parameter : label.parameters)
        help.parameters.push_back(
            {parameter.begin, parameter.end, parameterDocumentation(snapshot, *parameter.parameter)});
    help.active = call.atName ? parameterNamed(call, cursor.prefix) : call.parameter;
    if (!cursor.alternatives.empty())
        if (const int bound = boundParameter(file, call, offset); bound >= 0) help.active = bound;
    return help;
}

} // namespace rapid::query
