#pragma once

#include "fem/p1_triangle.hpp"
