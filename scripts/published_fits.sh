#!/usr/bin/env bash
# acquisition/brdf/published_fits.inc: the parameters of the published ABC and SGD fits of the MERL materials.
#   scripts/published_fits.sh FITS_DIR > acquisition/brdf/published_fits.inc
# FITS_DIR holds merl_abc_params.csv and merl_sgd_params.csv. Six significant digits.
set -euo pipefail
fits=$1
echo "// Written by scripts/published_fits.sh. A row: the model's members in their order."
echo "constexpr float kAbcFits[][9] = {"
awk -F, 'NR > 1 {row = ""; for (i = 2; i <= 10; ++i) row = row sprintf("%.6g, ", $i); print "    {" row "}, // " $1}' "$fits/merl_abc_params.csv" |
    awk '{gsub(/, }/, "}"); print}'
echo "};"
echo "constexpr float kSgdFits[][33] = {"
awk -F, 'NR > 1 {row = ""; for (i = 2; i <= 34; ++i) row = row sprintf("%.6g, ", $i); print "    {" row "}, // " $1}' "$fits/merl_sgd_params.csv" |
    awk '{gsub(/, }/, "}"); print}'
echo "};"
