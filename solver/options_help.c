/* The help texts of the command line. */
#include "solver/billow.h"
#include "solver/options.h"

static const char run_help[] =
    "usage: billow run DECK [-o DIR] [-j THREADS] [--end-time T] [--restart FILE] [--quiet]\n"
    "       billow i=DECK [ncpu=THREADS] [endtime=T] [jobid=NAME] [r=FILE]\n"
    "\n"
    "Runs an LS-DYNA keyword deck and writes its results to the folder DIR.\n"
    "\n"
    "  -o, --output DIR        folder of the results; by default the deck's name without its suffix\n"
    "                          + \".results\" (or NAME.results with jobid=NAME), in the working directory.\n"
    "                          It is made once the deck is accepted. Earlier results of billow in it are\n"
    "                          replaced; a folder that holds anything else is left alone (exit 2)\n"
    "  -j, --threads THREADS   threads to use; default: OMP_NUM_THREADS, else all processors. The number of\n"
    "                          threads does not change a single bit of the results\n"
    "      --end-time T        end time in place of the deck's *CONTROL_TERMINATION\n"
    "      --restart FILE      goes on from a checkpoint (DIR/restart.billow) of the same deck\n"
    "  -q, --quiet             no progress, only messages and the last line\n"
    "      --one-point-quads   4-node elements with one point and hourglass control: faster, less accurate\n"
    "      --all-explicit      the smallest elements set the step, none is integrated implicitly\n"
    "      --caps-push-rim     flat caps over the bag's holes give their pressure force to the rim\n"
    "      --walls-block       fabric on rigid walls is blocked, as fabric in contact is\n"
    "      --relax             starts from the static equilibrium under the loads and bag pressures of time 0\n"
    "      --energy-error-limit X   stop when the energy balance is lost by more than this share (0.1)\n"
    "      --sensor-library FILE    shared library with the sensor function of bags with RBID > 0; its code\n"
    "                          runs with your rights\n"
    "\n"
    "Ctrl-C or SIGTERM finishes the step, writes a state and a checkpoint and ends. A file d3kil in the\n"
    "working directory with sw1 (checkpoint and stop), sw2 (print the time), sw3 (checkpoint) or sw4 (write\n"
    "a state) does what LS-DYNA users expect.\n"
    "Exit codes: 0 normal, 1 numerical failure, 2 error in deck or command line, 3 file system or memory.\n";

static const char fold_help[] =
    "usage: billow fold DECK FOLDS [-o FILE]\n"
    "\n"
    "Folds a flat bag and writes the folded deck with the flat bag as *AIRBAG_REFERENCE_GEOMETRY. FOLDS is a text\n"
    "with one statement a line; # starts a comment:\n"
    "\n"
    "  gap LENGTH               distance of layers (needed)\n"
    "  upper PART ...           parts of the panel above (needed)\n"
    "  lower PART ...           parts of the panel below (needed)\n"
    "  thin X Y DX DY up|down [ANGLE]         fold about the line through (X, Y), across (DX, DY), which points\n"
    "                           to the side that moves; by 180 degrees, or ANGLE for the last fold\n"
    "  zig-zag X Y DX DY up|down PITCH COUNT  bellows of COUNT lines, PITCH apart\n"
    "  roll X Y DX DY up|down COUNT           COUNT turns, the first about the line given\n"
    "  tuck X Y DX DY           the side beyond the line goes in between the panels (before other folds)\n"
    "  ramp LENGTH, spread LENGTH             from a seam to the full gap; beside creases, where layers slip\n"
    "                           (each a tenth of the bag by default)\n"
    "  limit SHARE              largest change of an edge's length accepted (0.2)\n"
    "\n"
    "  -o, --output FILE        default: the deck's name without its suffix + \".folded.k\", in the working directory\n"
    "Exit codes: 0 written, 2 error in deck, folds or command line, 3 file system or memory.\n";

void options_print_help(Command command, FILE *stream)
{
    if (command == COMMAND_RUN_HELP) {
        fputs(run_help, stream);
    } else if (command == COMMAND_CHECK_HELP) {
        fputs("usage: billow check DECK [--end-time T] [--one-point-quads] [--caps-push-rim]\n"
              "                         [--walls-block] [--all-explicit] [--relax] [--sensor-library FILE]\n"
              "\n"
              "Reads and validates a deck and reports parts, masses, bags with volume, holes and gas, the stable\n"
              "time step with its element, and every field that is read but not used. Runs no steps, writes no file.\n"
              "Exit codes: 0 the deck is good, 2 it has errors, 3 file system or memory.\n",
              stream);
    } else if (command == COMMAND_FOLD_HELP) {
        fputs(fold_help, stream);
    } else {
        fputs("billow " BILLOW_VERSION ", explicit membrane solver with airbags for LS-DYNA keyword decks\n"
              "\n"
              "usage: billow run DECK [-o DIR] [-j THREADS] [--end-time T] [--restart FILE] [--quiet]\n"
              "       billow check DECK         read, validate and report; no steps, no files\n"
              "       billow fold DECK FOLDS [-o FILE]    fold a flat bag; writes a deck with its reference\n"
              "       billow i=DECK ncpu=2 endtime=T jobid=NAME r=FILE      LS-DYNA's spelling of run\n"
              "       billow --version | --help | run --help | check --help | fold --help\n",
              stream);
    }
}
