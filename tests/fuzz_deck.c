/* libFuzzer target of the reader: any bytes give definitions or messages, never a crash, a leak or a hang.
 * Seeds are in tests/corpus; *INCLUDE finds only what lies in the working directory. */
#include <stddef.h>
#include <stdint.h>

#include "io/read.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    Definitions definitions = {0};
    Diagnostics diagnostics = {0};
    deck_read_text("fuzz.k", (const char *)data, size, &definitions, &diagnostics);
    definitions_free(&definitions);
    diagnostics_free(&diagnostics);
    return 0;
}
