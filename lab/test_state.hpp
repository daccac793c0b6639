// What a test has measured so far, as part of a checkpoint. Names begin with `prefix`.
#pragma once

#include <string>
#include <vector>

#include "core/state.hpp"
#include "lab/failure_event.hpp"
#include "reports/record/record.hpp"

namespace proveta {

/// The rows of a table whose columns are there already.
void visit_rows(const std::string& prefix, report::Table& table, StateVisitor& visit);

void visit_events(const std::string& prefix, std::vector<FailureEvent>& events, StateVisitor& visit);

void visit_picture(const std::string& prefix, report::Picture& picture, StateVisitor& visit);

} // namespace proveta
