/* Minimal assert.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_ASSERT_H
#define ROBOSMI_ASSERT_H
void robosmi_assert(int condition);
#define assert(condition) robosmi_assert((condition) != 0)
#endif
