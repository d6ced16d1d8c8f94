#pragma once
// The attributes of predefined names, as enumerations; the words are in builtin_words.def. No library is needed: the
// generator of the standard library uses it, too.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace rapid::sema {

/// How a native may be called; from `effects:` in the declaration.
enum class Effects : uint8_t {
    None,
#define EFFECTS(Name, word) Name,
#include "frontend/sema/builtin_words.def"
};

/// The place where execution continues after a predefined procedure; from `flow:` in the declaration.
enum class Flow : uint8_t {
    Continues,
#define FLOW(Name, word) Name,
#include "frontend/sema/builtin_words.def"
};

/// Kinds of argument that a parameter of type anytype takes; from `where:` in the declaration.
enum class ParamClass : uint8_t {
    Any,
#define PARAM_CLASS(Name, words) Name,
#include "frontend/sema/builtin_words.def"
};

/// From `class:` in the declaration of a type or data object.
enum class TypeClass : uint8_t {
    Plain,
#define TYPE_CLASS(Name, word) Name,
#include "frontend/sema/builtin_words.def"
};

/// Predefined data that the compiler itself knows; from `meaning:` in the declaration.
enum class Meaning : uint8_t {
    None,
#define MEANING(Name, word) Name,
#include "frontend/sema/builtin_words.def"
};

/// Predefined types that the compiler itself knows; from `known:` in the declaration.
enum class KnownType : uint8_t {
    None,
#define KNOWN_TYPE(Name, word) Name,
#include "frontend/sema/builtin_words.def"
};

/// Error numbers that constructs of the language raise; from `raisedby:` in the declaration (manual 1.12).
enum class LanguageError : uint8_t {
    None,
#define LANGUAGE_ERROR(Name, word) Name,
#include "frontend/sema/builtin_words.def"
};

/// Properties of a native for checker, warnings and lowering; from `traits:` in the declaration.
enum class Trait : uint8_t {
#define TRAIT(Name, word) Name,
#include "frontend/sema/builtin_words.def"
};

/// Predefined routines that the compiler itself knows; from `role:` in the declaration.
enum class Role : uint8_t {
    None,
#define ROLE(Name, word, hasCode) Name,
#include "frontend/sema/builtin_words.def"
};

/// A set of traits.
class Traits {
  public:
    bool has(Trait trait) const { return (bits_ >> static_cast<unsigned>(trait) & 1U) != 0; }
    void add(Trait trait) { bits_ |= uint32_t{1} << static_cast<unsigned>(trait); }

  private:
    uint32_t bits_ = 0;
};

template <class Enum> struct BuiltinWord {
    std::string_view word;
    Enum value;
};

inline constexpr BuiltinWord<Effects> kEffectsWords[] = {
#define EFFECTS(Name, word) {word, Effects::Name},
#include "frontend/sema/builtin_words.def"
};
inline constexpr BuiltinWord<Flow> kFlowWords[] = {
#define FLOW(Name, word) {word, Flow::Name},
#include "frontend/sema/builtin_words.def"
};
inline constexpr BuiltinWord<ParamClass> kParamClassWords[] = {
#define PARAM_CLASS(Name, words) {words, ParamClass::Name},
#include "frontend/sema/builtin_words.def"
};
inline constexpr BuiltinWord<TypeClass> kTypeClassWords[] = {
#define TYPE_CLASS(Name, word) {word, TypeClass::Name},
#include "frontend/sema/builtin_words.def"
};
inline constexpr BuiltinWord<Meaning> kMeaningWords[] = {
#define MEANING(Name, word) {word, Meaning::Name},
#include "frontend/sema/builtin_words.def"
};
inline constexpr BuiltinWord<KnownType> kKnownTypeWords[] = {
#define KNOWN_TYPE(Name, word) {word, KnownType::Name},
#include "frontend/sema/builtin_words.def"
};
inline constexpr BuiltinWord<LanguageError> kLanguageErrorWords[] = {
#define LANGUAGE_ERROR(Name, word) {word, LanguageError::Name},
#include "frontend/sema/builtin_words.def"
};
inline constexpr BuiltinWord<Trait> kTraitWords[] = {
#define TRAIT(Name, word) {word, Trait::Name},
#include "frontend/sema/builtin_words.def"
};
inline constexpr BuiltinWord<Role> kRoleWords[] = {
#define ROLE(Name, word, hasCode) {word, Role::Name},
#include "frontend/sema/builtin_words.def"
};
inline constexpr std::string_view kAttributeKeys[] = {
#define KEY(word) word,
#include "frontend/sema/builtin_words.def"
};

static_assert(std::size(kTraitWords) <= 32);

/// Length of a table by KnownType.
inline constexpr std::size_t kKnownTypes = std::size(kKnownTypeWords) + 1;

/// The value of a word; none for a word that is not in the list.
template <class Enum, std::size_t N>
constexpr std::optional<Enum> valueOf(const BuiltinWord<Enum> (&words)[N], std::string_view word) {
    for (const BuiltinWord<Enum>& entry : words)
        if (entry.word == word) return entry.value;
    return std::nullopt;
}

/// Whether a routine of this role has a native implementation.
constexpr bool hasCode(Role role) {
    switch (role) {
    case Role::None: return true;
#define ROLE(Name, word, hasCode)                                                                            \
    case Role::Name: return hasCode;
#include "frontend/sema/builtin_words.def"
    }
    return true;
}

} // namespace rapid::sema
