#pragma once
// Digests, random numbers and comparisons of secrets, by OpenSSL.

#include <cstddef>
#include <string>
#include <string_view>

namespace rapidc::http {

/// Unpredictable bytes of the operating system. Ends the process when there are none.
std::string randomBytes(std::size_t count);
/// Lower case, two digits for each byte.
std::string hexOf(std::string_view bytes);
/// So many random bytes as hexadecimal digits.
std::string randomHex(std::size_t bytes);

/// MD5 as hexadecimal digits: what Digest login of RWS 1.0 demands.
std::string md5Hex(std::string_view text);
std::string sha256(std::string_view bytes);
std::string hmacSha256(std::string_view key, std::string_view bytes);
/// PBKDF2 with HMAC-SHA-256, 32 bytes: slow on purpose.
std::string derivePassword(std::string_view password, std::string_view salt, int iterations);

/// Compares without a hint in time about where two secrets differ.
bool equalSecrets(std::string_view a, std::string_view b);

} // namespace rapidc::http
