#include "tools/http/tls.h"

#include "config/atomic_file.h"
#include "config/read_file.h"

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace rapidc::http {

namespace {

template <auto Free> struct Freed {
    template <class T> void operator()(T* object) const { Free(object); }
};
using Certificate = std::unique_ptr<X509, Freed<X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using Bio = std::unique_ptr<BIO, Freed<BIO_free_all>>;

constexpr long kDay = 24L * 60 * 60;
constexpr long kLifeTime = 3650 * kDay;
constexpr long kLeastLeft = 30 * kDay;

bool isAddress(const std::string& name) {
    return name.find(':') != std::string::npos || name.find_first_not_of("0123456789.") == std::string::npos;
}

std::vector<std::string> allNames(const std::vector<std::string>& names) {
    std::vector<std::string> all{"127.0.0.1", "localhost", "::1"};
    for (const std::string& name : names)
        if (!name.empty() && name != "0.0.0.0" && name != "::") all.push_back(name);
    return all;
}

std::string textOf(BIO* bio) {
    char* data = nullptr;
    const long size = BIO_get_mem_data(bio, &data);
    return {data, static_cast<std::size_t>(size)};
}

bool addExtension(X509* certificate, int kind, const std::string& value) {
    X509V3_CTX context;
    X509V3_set_ctx_nodb(&context);
    X509V3_set_ctx(&context, certificate, certificate, nullptr, nullptr, 0);
    X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str());
    if (!extension) return false;
    const bool isAdded = X509_add_ext(certificate, extension, -1) == 1;
    X509_EXTENSION_free(extension);
    return isAdded;
}

bool setSerial(X509* certificate) {
    unsigned char bytes[16];
    if (RAND_bytes(bytes, sizeof bytes) != 1) return false;
    bytes[0] &= 0x7F; // positive
    BIGNUM* number = BN_bin2bn(bytes, sizeof bytes, nullptr);
    const bool isSet = number && BN_to_ASN1_INTEGER(number, X509_get_serialNumber(certificate));
    BN_free(number);
    return isSet;
}

Certificate certificateFor(EVP_PKEY* key, const std::vector<std::string>& names) {
    Certificate certificate(X509_new());
    X509* x = certificate.get();
    if (!x || !X509_set_version(x, 2) || !setSerial(x)) return nullptr;
    X509_gmtime_adj(X509_getm_notBefore(x), -kDay); // clocks of clients may be slow
    X509_gmtime_adj(X509_getm_notAfter(x), kLifeTime);
    if (!X509_set_pubkey(x, key)) return nullptr;
    X509_NAME* name = X509_get_subject_name(x);
    X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_UTF8,
                               reinterpret_cast<const unsigned char*>("rapidc virtual controller"), -1, -1,
                               0);
    X509_set_issuer_name(x, name);
    std::string alternatives;
    for (const std::string& each : names)
        alternatives +=
            (alternatives.empty() ? "" : ",") + std::string(isAddress(each) ? "IP:" : "DNS:") + each;
    const bool isComplete = addExtension(x, NID_subject_alt_name, alternatives) &&
                            addExtension(x, NID_basic_constraints, "critical,CA:FALSE") &&
                            addExtension(x, NID_key_usage, "critical,digitalSignature") &&
                            addExtension(x, NID_ext_key_usage, "serverAuth") &&
                            addExtension(x, NID_subject_key_identifier, "hash");
    if (!isComplete || X509_sign(x, key, EVP_sha256()) == 0) return nullptr;
    return certificate;
}

std::shared_ptr<const TlsIdentity> newIdentity(const std::vector<std::string>& names) {
    const Key key(EVP_EC_gen("P-256"));
    const Certificate certificate = key ? certificateFor(key.get(), names) : nullptr;
    if (!certificate) return nullptr;
    const Bio certificateText(BIO_new(BIO_s_mem()));
    const Bio keyText(BIO_new(BIO_s_mem()));
    if (!PEM_write_bio_X509(certificateText.get(), certificate.get()) ||
        !PEM_write_bio_PrivateKey(keyText.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr))
        return nullptr;
    return std::make_shared<TlsIdentity>(textOf(certificateText.get()), textOf(keyText.get()));
}

bool holds(X509* certificate, const std::string& name) {
    if (isAddress(name)) return X509_check_ip_asc(certificate, name.c_str(), 0) == 1;
    return X509_check_host(certificate, name.c_str(), name.size(), 0, nullptr) == 1;
}

/// The identity in a text of PEM when it can still be used.
std::shared_ptr<const TlsIdentity> identityIn(const std::string& text,
                                              const std::vector<std::string>& names) {
    const Bio first(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
    const Key key(PEM_read_bio_PrivateKey(first.get(), nullptr, nullptr, nullptr));
    const Bio second(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
    const Certificate certificate(PEM_read_bio_X509(second.get(), nullptr, nullptr, nullptr));
    if (!key || !certificate || X509_check_private_key(certificate.get(), key.get()) != 1) return nullptr;
    time_t needed = time(nullptr) + kLeastLeft;
    if (X509_cmp_time(X509_get0_notAfter(certificate.get()), &needed) <= 0) return nullptr;
    for (const std::string& name : names)
        if (!holds(certificate.get(), name)) return nullptr;
    const std::size_t begin = text.find("-----BEGIN CERTIFICATE-----");
    return std::make_shared<TlsIdentity>(text.substr(begin), text.substr(0, begin));
}

/// "" or why the file cannot be written. Only its owner can read it.
std::string writeSecret(const std::string& path, const std::string& bytes) {
    const std::string temporary = path + ".new";
    unlink(temporary.c_str());
    const int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0) return temporary + ": " + std::strerror(errno);
    const bool isWritten =
        write(file, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()) && fsync(file) == 0;
    close(file);
    if (isWritten && rename(temporary.c_str(), path.c_str()) == 0) return {};
    return path + ": " + std::strerror(errno);
}

} // namespace

std::shared_ptr<const TlsIdentity>
TlsIdentity::make(const std::string& folder, const std::vector<std::string>& names, std::string& why) {
    const std::vector<std::string> wanted = allNames(names);
    const std::string path = folder + "/server.pem";
    std::string text;
    if (!folder.empty() && rapid::config::readFile(path, text).empty())
        if (auto kept = identityIn(text, wanted)) return kept;
    auto made = newIdentity(wanted);
    if (!made) {
        why = "cannot make a certificate";
        return nullptr;
    }
    if (folder.empty()) return made;
    why = writeSecret(path, made->key() + made->certificate());
    if (why.empty()) why = rapid::config::replaceFile(folder + "/server.crt", made->certificate());
    return why.empty() ? made : nullptr;
}

} // namespace rapidc::http
