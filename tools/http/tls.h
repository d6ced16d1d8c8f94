#pragma once
// TlsIdentity: certificate and key of this server. It is self-signed: clients of a virtual controller do not check it, or are given it.

#include <memory>
#include <string>
#include <vector>

namespace rapidc::http {

class TlsIdentity {
  public:
    /// Takes the identity from `folder`, or makes one and keeps it there: server.pem holds key and certificate and is readable for its
    /// owner only; server.crt holds the certificate, for clients. An
    /// identity that has expired, is damaged or does not hold all names is replaced. "": kept in memory only. `names`: addresses and
    /// names of the host besides 127.0.0.1 and localhost. Null and `why` when the folder cannot be used.
    static std::shared_ptr<const TlsIdentity> make(const std::string& folder,
                                                   const std::vector<std::string>& names, std::string& why);

    TlsIdentity(std::string certificate, std::string key)
        : certificate_(std::move(certificate)), key_(std::move(key)) {}
    const std::string& certificate() const { return certificate_; } ///< PEM
    const std::string& key() const { return key_; }                 ///< PEM

  private:
    std::string certificate_, key_;
};

} // namespace rapidc::http
