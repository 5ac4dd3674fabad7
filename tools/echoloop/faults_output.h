// What the verbs say about faults: the table of kinds, and what a run has made of them.
#pragma once

#include <memory>
#include <string>

#include "emulator/faults/labels.h"
#include "tools/echoloop/verb.h"

namespace echoloop::cli {

/// Every kind with its parameters, for people.
void print_fault_kinds();
/// {"faults": [{"name", "help", "parameters": [...]}]}
std::string fault_kinds_json();

/// The file of --labels; nullptr without it.
std::unique_ptr<BackgroundFile> labels_from(const Arguments& arguments);

/// By device and kind; prints nothing if there are none.
void print_faults(const std::map<std::string, FaultCounts>& counts);
void print_labels(const BackgroundFile& labels);

}  // namespace echoloop::cli
