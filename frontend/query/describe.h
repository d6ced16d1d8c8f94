#pragma once
// Declarations as one line (records: one line for each component), values and types as text, comments above declarations.

#include "frontend/query/meaning.h"

namespace rapid::query {

/// "num", "num{*,*}", "string{3}"; "switch" for a parameter without type.
std::string typeText(const sema::DataType& type);

/// One parameter: "\num count", "VAR string text", "PERS tooldata Tool".
std::string parameterText(const sema::DataSymbol& parameter);

/// A piece of the text of a routine's parameters.
struct ParameterLabel {
    const sema::DataSymbol* parameter = nullptr;
    uint32_t begin = 0, end = 0; ///< bytes in RoutineLabel::text
};
/// "PROC report(string text\num count)", with the places of the parameters in it.
struct RoutineLabel {
    std::string text;
    std::vector<ParameterLabel> parameters;
};
RoutineLabel routineLabel(const sema::RoutineSymbol& routine);

/// "PERS num total", "PROC report(string text\num count)", "RECORD part ... ENDRECORD", "num x" for a parameter.
std::string declarationText(const Snapshot& snapshot, const Meaning& meaning);
std::string declarationText(const Snapshot& snapshot, const sema::Symbol& symbol);

/// The comment above a declaration (documentation lines for what is predefined), without marks; without one, the comment
/// after it on the same line. Lines are joined by '\n'.
std::string commentOf(const Snapshot& snapshot, const Meaning& meaning);
std::string commentOf(const Snapshot& snapshot, const sema::Symbol& symbol);
/// The same as Markdown: parameters, errors and examples of what is predefined as lists and code.
std::string documentationOf(const Snapshot& snapshot, const Meaning& meaning);
std::string documentationOf(const Snapshot& snapshot, const sema::Symbol& symbol);
/// The line of a predefined routine's documentation about one parameter.
std::string parameterDocumentation(const Snapshot& snapshot, const sema::DataSymbol& parameter);

/// A number as RAPID writes it: "10", "0.1", "9E+09"; `single`: num.
std::string numberText(double value, bool single);
/// "[1,2.5,TRUE]", "\"abc\""; cut to about `limit` characters with "...".
std::string valueText(const sema::ConstValue& value, const sema::DataType& type, size_t limit = 400);
/// The value of data or of an expression that is known without a run: constants only; null: none.
const sema::ConstValue* constantOf(const sema::Symbol& symbol);

} // namespace rapid::query
