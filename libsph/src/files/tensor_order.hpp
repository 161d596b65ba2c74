// The order of the components of a symmetric tensor in files: xx yy zz xy yz xz, in which ParaView takes six
// numbers, where the state has xx yy zz xy xz yz (sph/core/fields.hpp). In 2D both are xx yy xy. The attribute
// "components" of the data set says so; snapshots of earlier versions lack it and have the order of the
// state.
#pragma once

#include <string>
#include <vector>

#include "files/hdf5_file.hpp"

namespace sph {

[[nodiscard]] std::string components_in_files(int dim);

/// From the order of the state to that of files, or back.
void exchange_yz_xz(double* values, std::size_t rows);

/// Brings rows read from `data_set` into the order of the state. Throws std::runtime_error if it does not say
/// its order.
void to_state_order(const Hdf5Reader& file, const std::string& data_set, int dim, double* values,
                    std::size_t rows);

}  // namespace sph
