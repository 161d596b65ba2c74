// What most tests include, parsed once a binary: half of the time of compiling them. A file includes what it uses all
// the same.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "sph/scene/scene.hpp"
#include "sph/step/simulation.hpp"
