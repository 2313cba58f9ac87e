/* billow: the program's entry. */
#include <stdio.h>

#include "fold/fold.h"
#include "solver/billow.h"
#include "solver/check.h"
#include "solver/options.h"
#include "solver/run.h"

int main(int argc, char **argv)
{
    Options options;
    if (options_parse(argc, argv, &options)) {
        fprintf(stderr, "billow: %s\n", options.error);
        return BILLOW_EXIT_INPUT;
    }
    switch (options.command) {
    case COMMAND_RUN:
        return run_deck(&options);
    case COMMAND_CHECK:
        return check_deck(&options);
    case COMMAND_FOLD:
        return fold_deck(options.deck, options.folds, options.directory);
    case COMMAND_VERSION:
        printf("billow %s\n", BILLOW_VERSION);
        return BILLOW_EXIT_NORMAL;
    default:
        options_print_help(options.command, stdout);
        return BILLOW_EXIT_NORMAL;
    }
}
