// The page of reports, as studio/report/report.html holds it: what comes before and after its data.
#pragma once

#include <string_view>

namespace tetsoup::page_template {

extern const std::string_view kBeforeData, kAfterData;

}  // namespace tetsoup::page_template
