#pragma once
// The boundary to the runtime as LLVM sees it, derived from rt_abi.h: types of structs and functions, access to fields,
// calls. Names and types come from one token, so that codegen cannot differ from the header.

#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Module.h>
#include <llvm/Support/TypeName.h>

#include <concepts>
#include <string>

#include "codegen/abi_fields.h"

namespace codegen::abi {

namespace detail {

std::string structName(llvm::StringRef cppName); ///< "rt.Frame" for rt::Frame
llvm::StructType* structNamed(llvm::LLVMContext& context, const std::string& name, const Field* fields,
                              size_t count);
/// Ends the compiler: a value has not the type of the field it is meant for.
[[noreturn]] void wrongType(llvm::StringRef place, const llvm::Type& wanted, const llvm::Type& given);

} // namespace detail

/// The struct type of T; one for each context.
template <class T> llvm::StructType* structType(llvm::LLVMContext& context) {
    static_assert(LaidOutNaturally<T>, "LLVM would lay this struct out in a different way than C++");
    static const std::string name = detail::structName(llvm::getTypeName<T>());
    return detail::structNamed(context, name, kFields<T>.data(), kFields<T>.size());
}

template <class T> llvm::Type* typeOf(llvm::LLVMContext& context) {
    if constexpr (std::is_void_v<T>)
        return llvm::Type::getVoidTy(context);
    else if constexpr (std::is_pointer_v<T>)
        return llvm::PointerType::getUnqual(context);
    else if constexpr (std::is_integral_v<T> || std::is_enum_v<T>)
        return llvm::IntegerType::get(context, 8 * sizeof(T));
    else if constexpr (std::is_same_v<T, float>)
        return llvm::Type::getFloatTy(context);
    else if constexpr (std::is_same_v<T, double>)
        return llvm::Type::getDoubleTy(context);
    else if constexpr (std::is_array_v<T>)
        return llvm::ArrayType::get(typeOf<std::remove_extent_t<T>>(context), std::extent_v<T>);
    else
        return structType<T>(context);
}

/// Integers below 32 bits would need attributes that say how they are extended, structs by value what the platform's ABI
/// makes of them.
template <class T>
concept PassedPlainly = std::is_pointer_v<T> || std::is_same_v<T, float> || std::is_same_v<T, double> ||
                        ((std::is_integral_v<T> || std::is_enum_v<T>) && sizeof(T) >= 4);

namespace detail {

template <class Signature> struct SignatureParts;
template <class R, class... P> struct SignatureParts<R(P...)> {
    static_assert(((std::is_void_v<R> || PassedPlainly<R>) && ... && PassedPlainly<P>));
    static constexpr size_t kParameters = sizeof...(P);
    static llvm::FunctionType* type(llvm::LLVMContext& context) {
        return llvm::FunctionType::get(typeOf<R>(context), {typeOf<P>(context)...}, false);
    }
};
template <class R, class... P> struct SignatureParts<R (*)(P...)> : SignatureParts<R(P...)> {};

} // namespace detail

/// The type of a C function, given as a function type or as a pointer to it.
template <class Signature> llvm::FunctionType* functionType(llvm::LLVMContext& context) {
    return detail::SignatureParts<Signature>::type(context);
}

/// A function with a signature that C++ knows: a call with a different number of arguments does not compile.
template <class Signature> class Callee {
  public:
    Callee() = default;
    explicit Callee(llvm::Function* function) : function_(function) {}

    llvm::Function* function() const { return function_; }
    template <std::convertible_to<llvm::Value*>... V>
        requires(sizeof...(V) == detail::SignatureParts<Signature>::kParameters)
    llvm::CallInst* call(llvm::IRBuilderBase& b, V... arguments) const {
        const std::array<llvm::Value*, sizeof...(V)> values{arguments...};
        return b.CreateCall(function_, values);
    }

  private:
    llvm::Function* function_ = nullptr;
};

/// The name of a declaration of rt_abi.h as text.
#define RAPIDC_SYMBOL(name) (static_cast<void>(sizeof(decltype(::name)*)), #name)

/// Makes a function of the signature.
template <class Signature>
Callee<Signature> makeFunction(llvm::Module& module, llvm::GlobalValue::LinkageTypes linkage,
                               const llvm::Twine& name) {
    return Callee<Signature>(
        llvm::Function::Create(functionType<Signature>(module.getContext()), linkage, name, module));
}

/// Declares a function of the runtime (the name of a declaration in rt_abi.h) in an LLVM module.
#define RAPIDC_DECLARE_RUNTIME(module, name)                                                                 \
    ::codegen::abi::makeFunction<decltype(::name)>(module, ::llvm::Function::ExternalLinkage, #name)

/// Address of a field of `object`.
template <auto member>
llvm::Value* fieldAddress(llvm::IRBuilderBase& b, llvm::Value* object, const llvm::Twine& name = "") {
    return b.CreateStructGEP(structType<StructOf<member>>(b.getContext()), object,
                             static_cast<unsigned>(indexOf<member>()), name);
}

/// Address of an element of an array in `object`.
template <auto member>
llvm::Value* elementAddress(llvm::IRBuilderBase& b, llvm::Value* object, size_t element) {
    static_assert(std::is_array_v<TypeOf<member>>);
    return b.CreateConstInBoundsGEP1_64(
        b.getInt8Ty(), object, kOffsetOf<member> + element * sizeof(std::remove_extent_t<TypeOf<member>>));
}

template <auto member> llvm::LoadInst* loadField(llvm::IRBuilderBase& b, llvm::Value* object) {
    return b.CreateLoad(typeOf<TypeOf<member>>(b.getContext()), fieldAddress<member>(b, object));
}

template <auto member>
llvm::StoreInst* storeField(llvm::IRBuilderBase& b, llvm::Value* object, llvm::Value* content) {
    const llvm::Type* wanted = typeOf<TypeOf<member>>(b.getContext());
    if (content->getType() != wanted)
        detail::wrongType(llvm::getTypeName<StructOf<member>>(), *wanted, *content->getType());
    return b.CreateStore(content, fieldAddress<member>(b, object));
}

} // namespace codegen::abi
