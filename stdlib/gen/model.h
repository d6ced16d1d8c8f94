#pragma once
// What the declarations in stdlib/decl and stdlib/data say, read once and checked; every generated file is
// written from this.

#include "config/letter_case.h"
#include "frontend/sema/builtin_words.h"
#include "frontend/syntax/parser.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stdlibgen {

/// Place of a declaration, for messages and references.
struct Place {
    std::string file;
    uint32_t line = 0;
};

/// The `!!` lines (documentation) and `!@` lines (attributes) above a declaration.
struct Doc {
    std::string text;                        ///< lines joined by '\n', marks removed
    std::map<std::string, std::string> attr; ///< keys and words: frontend/sema/builtin_words.def
    std::string summary() const;             ///< the first sentence, or the first line
    std::string get(const std::string& key) const;
};

/// How a type is represented.
enum class Repr : uint8_t { Num, Dnum, Bool, String, Record, Handle, Bytes, Any, Switch };

struct TypeInfo {
    struct Field {
        std::string type, name;
    };
    std::string name;
    std::string aliasOf; ///< empty for records and atomic types
    Repr repr = Repr::Record;
    uint32_t bytes = 0; ///< Repr::Bytes: the capacity
    std::vector<Field> fields;
    Doc doc;
    Place place;
};

enum class Mode : uint8_t { In, Var, Pers, Inout, Ref };

struct Param {
    Mode mode = Mode::In;
    bool isSwitch = false;
    bool optional = false;
    bool alternative = false; ///< one of several required parameters joined by '|'
    uint32_t group = 0;
    std::string type, name;
    uint8_t rank = 0;
};

struct Routine {
    std::string name;
    std::string returnType; ///< empty: instruction
    std::vector<Param> params;
    std::string signature; ///< as written, white space collapsed
    bool native = false;
    rapid::sema::Role role = rapid::sema::Role::None;
    Doc doc;
    Place place;
};

struct Datum {
    std::string kind; ///< CONST, PERS, VAR
    std::string type, name;
    std::string initText;
    std::optional<double> number; ///< numeric constants
    Doc doc;
    Place place;
};

struct SourceText {
    std::string name; ///< "decl/math.sysx"
    std::string path; ///< as given, and as in Place::file
    std::string text;
};

struct Model {
    std::vector<TypeInfo> types;
    std::vector<Routine> routines;
    std::vector<Datum> data;
    std::vector<SourceText> sources;
    std::vector<std::string> errors; ///< "file:line: what is wrong"

    /// Case-insensitive; null if absent.
    const TypeInfo* findType(std::string_view name) const;
    /// Aliases resolved; null if unknown.
    const TypeInfo* baseType(std::string_view name) const;
};

/// Reads all files, in the order given; problems land in Model::errors.
Model readDeclarations(const std::vector<std::string>& paths);

/// Splits the `!!` and `!@` lines directly above `offset` off the text. `problem` is set for an unknown
/// attribute.
Doc readDocumentation(std::string_view text, uint32_t offset, std::string& problem);

/// "@param File  its path": the first word, and the rest without the blanks before it.
std::pair<std::string, std::string> splitFirstWord(const std::string& text);

/// Broken rules of declarations, each as in Model::errors: documentation (summary, parameters, result,
/// errors), attributes that every routine has, names in `raises:` and `deferred:`, numbers of errors. Names in one declaration may
/// be anywhere in the model.
std::vector<std::string> brokenRules(const Model& model);

/// A mistake in the attribute `where:` of a routine; empty: none.
std::string whereProblem(const Routine& routine);

} // namespace stdlibgen
