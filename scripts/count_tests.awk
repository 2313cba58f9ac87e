# Counts the test cases in ctest's log of cmocka programs: N passed, N failed[, N skipped]; exits 1 if any failed.
# A program that ends without naming a failed case and without success (a crash, a time limit) counts as one failure.

function close_program() {
    if (open && !good && listed == 0) failed++
    open = 0
}
# the opening line of a program in the log
/^[0-9]+\/[0-9]+ Testing: / { close_program(); open = 1; good = 0; listed = 0 }
/\[       OK \] / { passed++ }
/\[  FAILED  \] [0-9]+ test\(s\), listed below:/ { sub(/.*\[  FAILED  \] /, ""); failed += $1; listed += $1; next }
/\[  SKIPPED \] [0-9]+ test\(s\), listed below:/ { sub(/.*\[  SKIPPED \] /, ""); skipped += $1; next }
/^Test Passed\.$/ { good = 1 }
END {
    close_program()
    printf "%d passed, %d failed", passed, failed
    if (skipped > 0) printf ", %d skipped", skipped
    printf "\n"
    exit failed > 0 || passed == 0
}
