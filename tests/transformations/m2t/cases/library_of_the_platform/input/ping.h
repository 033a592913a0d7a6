#ifndef PING_H
#define PING_H
#if defined(__cplusplus)
extern "C" {
#endif
int ping(int pin);
int ping_cm(int pin);
int ping_inches(int pin);
typedef struct echo echo_t;
#if defined(__cplusplus)
}
#endif
#endif
