// The bag of `echoloop run --mcap`: what a run tells it, and what is printed of it.
#pragma once

#include <memory>

#include "emulator/run/runtime.h"
#include "tools/bag/bag.h"
#include "tools/echoloop/verb.h"

namespace echoloop::cli {

/// nullptr without --mcap. Throws StartError.
std::unique_ptr<bag::Bag> bag_from(const Arguments& arguments);
/// What its topics are told of a run.
bag::About about(const Runtime& runtime);
/// Once the run is made.
void begin(bag::Bag& bag, const Runtime& runtime);
void print_bag(const bag::Bag& bag);

}  // namespace echoloop::cli
