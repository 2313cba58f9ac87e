/* Reserving disk space for a file. */
#include "io/disk_space.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

int disk_space_reserve(DiskSpace *space, const char *path, off_t bytes)
{
    struct stat before, after;
    if (space->file < 0) space->file = open(path, O_RDWR | O_CLOEXEC);
    if (space->file < 0 || fstat(space->file, &before)) return -1;
    int cause = posix_fallocate(space->file, before.st_size, bytes);
    if (cause == 0) return 0;
    if (fstat(space->file, &after) == 0 && after.st_size > before.st_size && ftruncate(space->file, before.st_size))
        cause = errno; /* a longer file opens as well */
    errno = cause;
    return -1;
}

int disk_space_trim(const DiskSpace *space, off_t size)
{
    return ftruncate(space->file, size);
}

int disk_space_close(DiskSpace *space)
{
    int status = space->file >= 0 ? close(space->file) : 0;
    space->file = -1;
    return status;
}
