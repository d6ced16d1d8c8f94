#include "tools/http/crypto.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <openssl/rand.h>

#include <cstdlib>

namespace rapidc::http {

namespace {

unsigned char* bytesOf(std::string& text) {
    return reinterpret_cast<unsigned char*>(text.data());
}

const unsigned char* bytesOf(std::string_view text) {
    return reinterpret_cast<const unsigned char*>(text.data());
}

std::string digestOf(const EVP_MD* kind, std::string_view bytes) {
    std::string result(EVP_MAX_MD_SIZE, '\0');
    unsigned length = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), bytesOf(result), &length, kind, nullptr) != 1) return {};
    result.resize(length);
    return result;
}

} // namespace

std::string randomBytes(std::size_t count) {
    std::string bytes(count, '\0');
    // Without random numbers every cookie could be guessed: better no server.
    if (RAND_bytes(bytesOf(bytes), static_cast<int>(count)) != 1) std::abort();
    return bytes;
}

std::string hexOf(std::string_view bytes) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string result;
    result.reserve(bytes.size() * 2);
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        result += {kDigits[byte >> 4], kDigits[byte & 15]};
    }
    return result;
}

std::string randomHex(std::size_t bytes) {
    return hexOf(randomBytes(bytes));
}

std::string md5Hex(std::string_view text) {
    return hexOf(digestOf(EVP_md5(), text));
}

std::string sha256(std::string_view bytes) {
    return digestOf(EVP_sha256(), bytes);
}

std::string hmacSha256(std::string_view key, std::string_view bytes) {
    std::string result(EVP_MAX_MD_SIZE, '\0');
    unsigned length = 0;
    if (!HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()), bytesOf(bytes), bytes.size(),
              bytesOf(result), &length))
        return {};
    result.resize(length);
    return result;
}

std::string derivePassword(std::string_view password, std::string_view salt, int iterations) {
    std::string result(32, '\0');
    if (PKCS5_PBKDF2_HMAC(password.data(), static_cast<int>(password.size()), bytesOf(salt),
                          static_cast<int>(salt.size()), iterations, EVP_sha256(),
                          static_cast<int>(result.size()), bytesOf(result)) != 1)
        return {};
    return result;
}

bool equalSecrets(std::string_view a, std::string_view b) {
    return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

} // namespace rapidc::http
