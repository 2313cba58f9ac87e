/* Requests from outside a run: Ctrl-C, SIGTERM and the file d3kil with its sense switches. */
#include "solver/signals.h"

#include <ctype.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

static volatile sig_atomic_t stop_requested;

static const int stop_signals[] = {SIGINT, SIGTERM, SIGHUP};
enum { STOP_SIGNALS = sizeof stop_signals / sizeof *stop_signals };

static void request_stop(int number)
{
    (void)number;
    stop_requested = 1;
    for (int i = 0; i < STOP_SIGNALS; i++) signal(stop_signals[i], SIG_DFL);
}

void signals_install(void)
{
    for (int i = 0; i < STOP_SIGNALS; i++) {
        struct sigaction old;
        if (sigaction(stop_signals[i], NULL, &old) || old.sa_handler == SIG_IGN) continue;
        struct sigaction action = {.sa_handler = request_stop, .sa_flags = SA_RESTART};
        sigemptyset(&action.sa_mask);
        sigaction(stop_signals[i], &action, NULL);
    }
    /* Output that cannot be written is an error to report, not a reason to die. */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
}

bool signals_stop_requested(void)
{
    return stop_requested != 0;
}

SenseSwitch signals_parse_switch(const char *text)
{
    static const struct {
        const char *name;
        SenseSwitch value;
    } names[] = {{"sw1", SENSE_STOP},
                 {"sw2", SENSE_PRINT},
                 {"sw3", SENSE_CHECKPOINT},
                 {"sw4", SENSE_STATE},
                 {"stop", SENSE_STOP}};
    while (isspace((unsigned char)*text)) text++;
    size_t length = strcspn(text, " \t\r\n");
    if (length > 0 && text[length - 1] == '.') length--;
    if (length == 0) return *text ? SENSE_UNKNOWN : SENSE_NONE;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strlen(names[i].name) == length && strncasecmp(names[i].name, text, length) == 0) return names[i].value;
    return SENSE_UNKNOWN;
}

SenseSwitch signals_read_switch(const char *path)
{
    FILE *file = fopen(path, "r");
    if (!file) return SENSE_NONE;
    char text[64];
    const size_t length = fread(text, 1, sizeof text - 1, file);
    text[length] = '\0';
    fclose(file);
    const SenseSwitch value = signals_parse_switch(text);
    /* A file without text is being written at this moment: look again later. */
    if (value != SENSE_NONE && unlink(path)) return SENSE_NONE;
    return value;
}
