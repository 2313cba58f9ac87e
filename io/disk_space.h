/* Disk space taken before a library starts to write that cannot stand a full disk. */
#ifndef BILLOW_DISK_SPACE_H
#define BILLOW_DISK_SPACE_H

#include <sys/types.h>

typedef struct DiskSpace {
    int file; /* descriptor of the file, -1 until the first reservation */
} DiskSpace;

/* Lengthens the existing file at path by bytes that are then there to be overwritten. 0, or -1 with errno set (ENOSPC,
 * EFBIG, EDQUOT, ...); the file then keeps its length. */
int disk_space_reserve(DiskSpace *space, const char *path, off_t bytes);

/* Gives back what lies beyond size bytes. 0, or -1 with errno set. */
int disk_space_trim(const DiskSpace *space, off_t size);

int disk_space_close(DiskSpace *space);

#endif
