// What most sources of the command include, parsed once where GROVE_PRECOMPILE_HEADERS is on.
#pragma once

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include "precompiled.h"
