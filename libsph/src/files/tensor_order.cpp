#include "files/tensor_order.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace sph {

std::string components_in_files(int dim) { return dim == 2 ? "xx yy xy" : "xx yy zz xy yz xz"; }

void exchange_yz_xz(double* values, std::size_t rows) {
  for (double* end = values + 6 * rows; values != end; values += 6) std::swap(values[4], values[5]);
}

void to_state_order(const Hdf5Reader& file, const std::string& data_set, int dim, double* values,
                    std::size_t rows) {
  if (dim == 2) return;
  const std::string wanted = components_in_files(dim), of_the_state = "xx yy zz xy xz yz";
  const std::string found =
      file.text_of(data_set, "components").value_or(file.has_attribute("format") ? of_the_state : "");
  if (found != wanted && found != of_the_state)
    throw std::runtime_error(
        fmt::format("data set \"{}\": its attribute \"components\" is \"{}\"; it must be \"{}\" or \"{}\"",
                    data_set, found, wanted, of_the_state));
  if (found == wanted) exchange_yz_xz(values, rows);
}

}  // namespace sph
