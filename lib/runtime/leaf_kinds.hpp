// The kinds of leaves that this build of the runtime reads.
#pragma once

#include <runtime/codec_plain.hpp>
#include <runtime/codec_predicted_strip.hpp>
#include <runtime/codec_strip.hpp>
#include <runtime/read_profiles.hpp>
