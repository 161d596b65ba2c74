// The fingerprint of a state: the sum modulo 2^128 of a hash of every particle's record (all state fields,
// keyed by global id), of every entry of a contact
// history, keyed by its carrier, and of the global record. Order-free, so any cut of the particles gives the
// same one.
#pragma once

#include <string>

#include "decomp/comm.hpp"
#include "sph/core/particles.hpp"

namespace sph {

/// Histories of the contacts of owned rows (ContactLists::pack), `width` bytes an entry.
struct ContactEntries {
  const decomp::Payload* payload = nullptr;
  std::size_t width = 0;
};

/// 32 hexadecimal digits. Collective. -0.0 and +0.0 differ, as every other bit does. Positions enter wrapped
/// into the domain.
[[nodiscard]] std::string fingerprint(const decomp::Comm& comm, const Particles& particles,
                                      const GlobalState& global, const PositionScale& scale, const Wrap& wrap,
                                      const ContactEntries& contacts = {});

}  // namespace sph
