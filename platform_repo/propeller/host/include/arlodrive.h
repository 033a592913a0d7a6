/* arlodrive.h of the Simple Libraries: the drive of the Arlo, a motor controller DHB-10 on one serial line. abdrive.h has functions of the
 * same names: which is meant is said by the header that a program includes. */
#ifndef ARLODRIVE_H
#define ARLODRIVE_H
#include "fdserial.h"
extern fdserial *arlo;
#define DHB10_LEN 64
#define SIDE_TERM 0
#define ARD_DEFAULT_SERVO_L 12
#define ARD_DEFAULT_SERVO_R 13
#define ARD_DEFAULT_SPEEDLIMIT 200
#define ARD_DEFAULT_ACCEL_LIMIT 512
#define ARD_DEFAULT_DONE_REPS 16
#define ARD_DEFAULT_RAMPSTEP 25
#define ARD_MODE_VERBOSE 1
#define ARD_MODE_CONCISE 0
#define drive_open arlodrive_drive_open
#define drive_close arlodrive_drive_close
#define drive_speed arlodrive_drive_speed
#define drive_goto arlodrive_drive_goto
#define drive_rampStep arlodrive_drive_rampStep
#define drive_ramp arlodrive_drive_ramp
#define drive_getTicks arlodrive_drive_getTicks
#define drive_getSpeed arlodrive_drive_getSpeed
#define drive_clearTicks arlodrive_drive_clearTicks
#define drive_setRampStep arlodrive_drive_setRampStep
#define drive_setMaxSpeed arlodrive_drive_setMaxSpeed
#define drive_servoPins arlodrive_drive_servoPins
#define drive_feedback arlodrive_drive_feedback
#define drive_gotoDoneDelay arlodrive_drive_gotoDoneDelay
#define drive_gotoBlocking arlodrive_drive_gotoBlocking
#define drive_speedBlocking arlodrive_drive_speedBlocking
char *drive_open();
void drive_close(void);
char *drive_speed(int left, int right);
char *drive_goto(int distLeft, int distRight);
void drive_rampStep(int left, int right);
void drive_ramp(int left, int right);
char *drive_getTicks(int *left, int *right);
char *drive_getSpeed(int *left, int *right);
char *drive_clearTicks(void);
void drive_setRampStep(int stepsize);
void drive_setMaxSpeed(int speed);
void drive_servoPins(int servoPinLeft, int servoPinRight);
void drive_feedback(int enabled);
void drive_gotoDoneDelay(int msTillDoneApprox);
void drive_gotoBlocking(int enabled);
void drive_speedBlocking(int enabled);
void dhb10_terminal(fdserial *fdterm);
char *dhb10_com(char *configStr);
#endif
