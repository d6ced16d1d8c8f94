#pragma once
// Symbols: what names mean. Owned by the CheckedProgram; pointers stay valid for its life.

#include "frontend/sema/builtin_words.h"
#include "frontend/sema/types.h"
#include "frontend/syntax/ast.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rapid::sema {

struct Module;
struct RoutineSymbol;

/// Value of a constant expression. Aggregates hold their members in order (arrays: nested by dimension). Texts and
/// members lie in an arena, and values that are equal may share them.
struct ConstValue {
    enum class Kind : uint8_t { None, Number, Bool, String, Aggregate } kind = Kind::None;
    bool boolean = false;
    uint32_t count = 0; ///< of the bytes of the text or of the members
    union {
        double number = 0;      ///< num values are already rounded to binary32
        const char* characters; ///< see text()
        ConstValue* elements;   ///< see members()
    };

    std::string_view text() const {
        return kind == Kind::String ? std::string_view(characters, count) : std::string_view();
    }
    std::span<ConstValue> members() const {
        return kind == Kind::Aggregate ? std::span<ConstValue>(elements, count) : std::span<ConstValue>();
    }
    void setText(std::string_view text, Arena& arena) {
        kind = Kind::String;
        count = static_cast<uint32_t>(text.size());
        characters = arena.copy(std::span<const char>(text)).data();
    }
    void setMembers(std::span<ConstValue> members) {
        kind = Kind::Aggregate;
        count = static_cast<uint32_t>(members.size());
        elements = members.data();
    }
};
static_assert(sizeof(ConstValue) == 16);

enum class SymbolKind : uint8_t { Type, Data, Routine, Module, Label };

/// How far a declaration has been worked out; declarations are resolved on demand, in any order.
enum class Progress : uint8_t { Pending, Active, Done };

/// Projects have hundreds of thousands of symbols: members of one size stand together, here and in DataSymbol.
struct Symbol {
    std::string name;                   ///< as declared
    Module* module = nullptr;           ///< configured objects: where they are named first
    const syntax::Node* decl = nullptr; ///< null for configured signals
    uint32_t nameId = 0;                ///< equal for names that differ only in case
    uint32_t users = 0;                 ///< files that refer to it
    syntax::TokenIndex nameToken = syntax::kNoToken;
    uint32_t lastUser = 0; ///< FileFacts::stamp of the file that was counted last
    SymbolKind kind = SymbolKind::Data;
    Progress progress = Progress::Pending; ///< types, and the data type of data
    bool isLocal = false;                  ///< LOCAL
    bool predefined = false;               ///< declared in stdlib
    bool used = false;
};

struct TypeSymbol : Symbol {
    Type* type = nullptr;
    /// As new, for another check of its file; what others refer to stays.
    void reset() {
        TypeSymbol fresh;
        fresh.users = users;
        fresh.used = users > 0;
        fresh.type = type;
        if (type) {
            type->~Type();
            new (type) Type();
        }
        *this = std::move(fresh);
    }
};

enum class Storage : uint8_t {
    ModuleData,  ///< program data (and predefined data)
    RoutineData, ///< declared in a routine
    Parameter,
    LoopVariable,
    /// Configured object, resolved by name when the program is loaded: an I/O signal, or, depending on `type`, a
    /// mechanical unit (`mecunit`) or the identity of a task (`taskid`).
    Signal,
    SystemVariable ///< ERRNO, INTNO ...
};

/// DataSymbol::index of a stand-in for an undeclared name: it is in no table.
inline constexpr uint32_t kNoIndex = UINT32_MAX;

struct DataSymbol : Symbol {
    Storage storage = Storage::ModuleData;
    syntax::DataKind dataKind = syntax::DataKind::Var;
    syntax::ScopeWord scope = syntax::ScopeWord::None;
    bool assumed = false; ///< a signal or mechanical unit that is known by its use only
    // Parameters
    syntax::ParamMode mode = syntax::ParamMode::In;
    bool optional = false;
    bool isSwitch = false;
    bool requiredAlternative = false; ///< built-ins: `a | b` between required parameters
    bool assigned = false;            ///< some statement writes it, or it is passed on as VAR, INOUT or PERS
    bool deferred = false; ///< parameter of a built-in whose expression is evaluated again and again
    ParamClass accepts = ParamClass::Any;              ///< parameters of type `anytype`
    Meaning meaning = Meaning::None;                   ///< predefined data
    LanguageError languageError = LanguageError::None; ///< predefined error numbers
    Progress valueProgress = Progress::Pending;

  private:
    mutable bool literal_ = false; ///< not read yet
    bool isLiteral_ = false;

  public:
    uint32_t group = 0;   ///< parameters: equal for mutually exclusive ones
    uint32_t index = 0;   ///< dense per routine (parameters first) or per module; or kNoIndex
    uint32_t writers = 0; ///< files that write it
    uint32_t lastWriter = 0;
    DataType type;
    const syntax::Expr* init = nullptr;
    RoutineSymbol* routine = nullptr; ///< routine data, parameters, loop variables

    /// CONST, and initial values of VAR and PERS at module level (None = zero).
    const ConstValue& value() const {
        if (literal_) readLiteral();
        return value_;
    }
    ConstValue& valueSlot() { return value_; }
    /// The value is that of `init`, a plain aggregate of this type; it is read when first asked for.
    void setLiteral() { literal_ = isLiteral_ = true; }
    bool isLiteralConstant() const { return isLiteral_ && dataKind == syntax::DataKind::Const; }

    void reset() {
        DataSymbol fresh;
        fresh.users = users;
        fresh.used = users > 0;
        fresh.writers = writers;
        fresh.assigned = writers > 0;
        *this = std::move(fresh);
    }

  private:
    void readLiteral() const; // literal_value.cpp

    mutable ConstValue value_;
};
static_assert(sizeof(void*) != 8 || sizeof(DataSymbol) <= 160);

struct RoutineSymbol : Symbol {
    syntax::RoutineKind routineKind = syntax::RoutineKind::Proc;
    const syntax::RoutineDecl* routineDecl = nullptr;
    DataType returnType; ///< functions
    std::vector<DataSymbol*> params;
    std::vector<DataSymbol*> data; ///< all routine data and loop variables
    bool incomplete = false;       ///< a parameter could not be read: calls are not judged
    bool native = false;           ///< declared without body in stdlib
    bool noStepIn = false;         ///< its module is NOSTEPIN or NOVIEW
    Effects effects = Effects::None;
    Flow flow = Flow::Continues;
    Role role = Role::None;
    Traits traits;
    bool raises = false;                         ///< natives: it may raise an error
    std::string raisedErrors;                    ///< natives: "ERR_A, ERR_B"
    bool uncertain = false;                      ///< built-ins: the form of the call is not confirmed
    uint8_t textLength = 0;                      ///< bytes of the text a native returns at least
    const DataSymbol* textLengthParam = nullptr; ///< parameter that says how many
    std::string option;                          ///< RobotWare option it needs
    std::vector<DataSymbol*> formerParams;       ///< of an earlier check, to be used again
    void reset() {
        RoutineSymbol fresh;
        fresh.users = users;
        fresh.used = users > 0;
        fresh.formerParams = std::move(params);
        *this = std::move(fresh);
    }
};

struct ModuleSymbol : Symbol {};

struct LabelSymbol : Symbol {
    RoutineSymbol* routine = nullptr;
};

} // namespace rapid::sema
