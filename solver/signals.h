/* Requests from outside a run: Ctrl-C, SIGTERM and the file d3kil with its sense switches. */
#ifndef BILLOW_SIGNALS_H
#define BILLOW_SIGNALS_H

#include <stdbool.h>
#include <stddef.h>

/* What LS-DYNA's sense switches ask for. */
typedef enum SenseSwitch {
    SENSE_NONE,
    SENSE_STOP,       /* sw1, stop: write a checkpoint and end */
    SENSE_PRINT,      /* sw2: print time and cycle, go on */
    SENSE_CHECKPOINT, /* sw3: write a checkpoint, go on */
    SENSE_STATE,      /* sw4: write a state, go on */
    SENSE_UNKNOWN,    /* a d3kil with anything else */
} SenseSwitch;

/* From now on the first Ctrl-C, SIGTERM or SIGHUP only raises the flag; the next one kills as usual. Signals that the
 * caller had ignored (nohup, background jobs) stay ignored. Writing into a closed pipe or beyond the
 * largest file allowed is no longer fatal. */
void signals_install(void);

/* True once a stop was asked for by a signal. */
bool signals_stop_requested(void);

/* The switch that text names: sw1 .. sw4 or stop, in upper or lower case, blanks around and a final period allowed.
 * SENSE_NONE for blank text. */
SenseSwitch signals_parse_switch(const char *text);

/* Reads and removes path ("d3kil"). SENSE_NONE when there is no such file or it is still empty. */
SenseSwitch signals_read_switch(const char *path);

#endif
