#pragma once

#include <string>
#include <vector>

#include "framework/study/report/comparison.h"
#include "framework/study/study_results.h"

namespace plaza {

/// A table of words, on its way to a terminal, Markdown or HTML. Rows have as many cells as the
/// head.
struct WordTable {
  std::string title;
  std::vector<std::string> head;
  std::size_t left = 0;  ///< so many first columns are words, the others numbers
  std::vector<std::vector<std::string>> rows;
};

/// One table per branch and section of the chosen metrics: variants in rows, the median over
/// repetitions in cells, with half the distance of the quartiles where there are several.
std::vector<WordTable> result_tables(const StudyResults& results);

/// Mean differences from the baseline with their intervals, one table per branch and section; none
/// without a baseline.
std::vector<WordTable> difference_tables(const StudyResults& results);

/// What went wrong, one line per job: "gate_m=0.5, seed 2: node 'tracks', frame 7: ...".
std::vector<std::string> failure_lines(const StudyResults& results);

/// For a terminal: columns of equal width, split where a table is wider than 100 characters.
std::string to_text(const WordTable& table);
/// For Markdown.
std::string to_markdown(const WordTable& table);

/// What the cells of difference tables are.
std::string difference_legend();

/// What the cells of result tables are: "median of 3 repetitions ± half the distance ...".
std::string cell_legend(const StudyResults& results);

}  // namespace plaza
