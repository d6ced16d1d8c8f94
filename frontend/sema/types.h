#pragma once
// Types of RAPID (manual 1.2.1). Type objects live in the CheckedProgram and are compared by pointer after resolving
// aliases.

#include "frontend/sema/builtin_words.h"

#include <cstdint>
#include <string>
#include <vector>

namespace rapid::syntax {
enum class PlainPiece : uint8_t;
}

namespace rapid::sema {

struct Module;

enum class TypeKind : uint8_t {
    Error, ///< already reported; compatible with everything
    Num,
    Dnum,
    Bool,
    String,
    Record,
    NonValue,  ///< clock, iodev ... : a handle; rawbytes: a container
    SemiValue, ///< signalxx: a handle with a readable value
    Switch,
    AnyType ///< pseudo-type of built-ins
};

/// More atomic parts than this are beyond the memory of a controller.
inline constexpr uint32_t kMaxLeaves = 100'000'000;

struct Type;

/// Type of a data object or expression: element type and array shape.
struct DataType {
    const Type* type = nullptr;
    uint8_t rank = 0;            ///< 0 = not an array
    int32_t dims[3] = {0, 0, 0}; ///< 0 = conformant, known at run time only
    bool isArray() const { return rank > 0; }
};

struct Type {
    Type() = default;
    Type(const Type&) = delete;
    Type& operator=(const Type&) = delete;

    struct Component {
        std::string name; ///< as written
        const Type* type = nullptr;
    };
    TypeKind kind = TypeKind::Error;
    KnownType known = KnownType::None; ///< predefined types; an alias has its own, or none
    std::string name;                  ///< as written in its declaration
    const Module* module = nullptr;    ///< that declares it; null: predefined
    const Type* aliasOf =
        nullptr; ///< aliases: the type named in the ALIAS; kind and components are the base's
    std::vector<Component> components; ///< records
    std::vector<uint32_t> sorted;      ///< records of many components: their indices by name
    uint32_t leaves = 1;               ///< atomic parts of a value; stops counting beyond kMaxLeaves
    /// Records of few atomic parts: the pieces of which all literals of the type consist.
    std::vector<syntax::PlainPiece> literalShape;
    uint32_t bytes = 0; ///< non-value types that are containers of bytes: their capacity; 0: a handle
    bool containsNonValue = false; ///< records with a non-value component are non-value
    bool unclear = false;          ///< a record of which a part could not be read
    bool uncertain = false;        ///< a record of an option, whose components differ between versions
    const DataType scalar = {this, 0, {}}; ///< type of data that are not arrays

    const Type* base() const {
        const Type* t = this;
        while (t->aliasOf)
            t = t->aliasOf;
        return t;
    }
    bool isNumeric() const { return kind == TypeKind::Num || kind == TypeKind::Dnum; }
    int findComponent(std::string_view name) const; ///< case-insensitive; -1 if absent
    void sortComponents();                          ///< when all of them are known: fills `sorted`
};

} // namespace rapid::sema
