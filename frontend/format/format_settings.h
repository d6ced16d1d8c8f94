#pragma once
// How source text is laid out: the section "format" of the project file (docs/formatting.md).

#include <cstdint>

namespace rapid::format {

/// Whether a place has one space; Keep: as written.
enum class Spacing : uint8_t { Tight, Spaced, Keep };
/// After a comma. Arguments: spaced in lists of arguments, parameters and values, tight in [ ] and { }.
enum class CommaSpacing : uint8_t { Tight, Arguments, Spaced, Keep };
/// Position of the label of a GOTO.
enum class LabelPlace : uint8_t { FirstColumn, Code };
enum class KeywordCase : uint8_t { Upper, Lower, Keep };
/// Canonical: predefined names are spelt as their declarations.
enum class NameCase : uint8_t { Keep, Canonical };

struct FormatSettings {
    uint32_t indent = 3;        ///< columns of one level, 1 to 16
    bool tabs = false;          ///< one tab a level instead of spaces
    uint32_t continuation = 0;  ///< columns that the rest of an instruction is moved in by; 0: two levels
    uint32_t maxBlankLines = 2; ///< consecutive blank lines that are kept
    uint32_t maxLineLength = 0; ///< longer lines are broken after commas; 0: lines are never broken
    KeywordCase keywords = KeywordCase::Upper;
    NameCase names = NameCase::Keep;
    Spacing assignments = Spacing::Tight;       ///< around := but not in arguments, where it is always tight
    Spacing operators = Spacing::Tight;         ///< around + - * / < = ... and |
    CommaSpacing commas = CommaSpacing::Tight;  ///< after ','
    Spacing optionalArguments = Spacing::Tight; ///< before '\'
    LabelPlace labels = LabelPlace::FirstColumn;
    bool indentModule = true;    ///< declarations stand one level inside of MODULE
    bool indentCase = false;     ///< CASE and DEFAULT stand one level inside of TEST
    bool indentHandlers = false; ///< ERROR, UNDO and BACKWARD stand one level inside of the routine
    bool keepCommentsInFirstColumn = false; ///< comments in column 1 are not moved
};

} // namespace rapid::format
