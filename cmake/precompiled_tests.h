// What most tests include, parsed once where GROVE_PRECOMPILE_HEADERS is on.
#pragma once

#include <gtest/gtest.h>

#include "precompiled.h"
