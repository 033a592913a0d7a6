/* servo360.h of the Simple Libraries: servos that turn all round and tell their angle. */
#ifndef SERVO360_H
#define SERVO360_H
#include "simpletools.h"
#define S360_UNITS_FULL_CIRCLE 360
#define S360_MAX_SPEED 2 * 4096
#define S360_VM 180
#define S360_VM_CCW S360_VM
#define S360_VM_CW S360_VM
#define S360_VB_CCW 200
#define S360_VB_CW -200
#define S360_CCW_POS 1
#define S360_CCW_NEG -1
#define S360_SPEED 1
#define S360_POSITION 2
#define S360_GOTO 3
#define S360_MONITOR 4
#define S360_DEVS_MAX 4
#define S360_RAMP_STEP 72 * 4096 / 360
#define S360_M 4348
#define S360_B -129
#define S360_ENC_RES 4096
#define S360_KPA 12000
#define S360_KIA 600
#define S360_KDA 6000
#define S360_POS_INTGRL_MAX 600
#define S360_SCALE_DEN_A 1000
#define S360_KPV 500
#define S360_KIV 0
#define S360_KDV 0
#define S360_VEL_INTGRL_MAX 0
#define S360_SCALE_DEN_V 1000
#define S360_PW_CENTER 15000
#define S360_CS_HZ 50
#define S360_UNITS_ENCODER 4096
#define S360_UNITS_REV 360
#define S360_SETTING_KPV 1
#define S360_SETTING_KIV 2
#define S360_SETTING_KDV 3
#define S360_SETTING_IV_MAX 4
#define S360_SETTING_KPA 5
#define S360_SETTING_KIA 6
#define S360_SETTING_KDA 7
#define S360_SETTING_IA_MAX 8
#define S360_SETTING_VB_CCW 9
#define S360_SETTING_VB_CW 10
#define S360_SETTING_VM_CCW 11
#define S360_SETTING_VM_CW 12
#define S360_A_MAX 524287
#define S360_SCALE_DEN_COUPLE 1000
#define S360_SCALE_COUPLE 2000
#define S360_LATENCY 3
#define S360_PWMAX 2400
#define S360_PWMIN -2400
int servo360_connect(int pinControl, int pinFeedback);
int servo360_angle(int pin, int position);
int servo360_getAngle(int pin);
int servo360_speed(int pin, int speed);
int servo360_getSpeed(int pin);
int servo360_goto(int pin, int position);
int servo360_getCsop(int pin);
int servo360_stop(int pin);
int servo360_setAcceleration(int pin, int unitsPerSecSquared);
int servo360_getAcceleration(int pin);
int servo360_setMaxSpeed(int pin, int speed);
int servo360_getMaxSpeed(int pin);
int servo360_setMaxSpeedEncoded(int pin, int speed);
int servo360_getTopSpeed(int pin);
int servo360_setRampStep(int pin, int stepSize);
int servo360_getRampStep(int pin);
int servo360_setAngleLimits(int pin, int ccwMax, int cwMax);
int servo360_getAngleLimits(int pin, int *ccwMax, int *cwMax);
int servo360_setAngleCtrlSpeedMax(int pin, int speed);
int servo360_getAngleCtrlSpeedMax(int pin);
int servo360_setAngleOffset(int pin, int angle);
int servo360_getAngleOffset(int pin);
int servo360_setUnitsFullCircle(int pin, int units);
int servo360_getUnitsFullCircle(int pin);
int servo360_setControlSys(int pin, int constant, int value);
int servo360_getControlSys(int pin, int constant);
int servo360_setTransferFunction(int pin, int constant, int value);
int servo360_setTurns(int pin, int turns);
int servo360_getTurns(int pin);
int servo360_couple(int pinA, int pinB);
int servo360_setCoupleScale(int pinA, int pinB, int scale);
int servo360_enable(int pin, int state);
int servo360_feedback(int pin, int state);
int servo360_set(int pinControl, int time);
int servo360_setAngleCalc(int pin, int angle);
int servo360_getAngleCalc(int pin);
int servo360_getAngle12Bit(int pin);
int servo360_getAngleFixedOrigin(int pin);
int servo360_unitsAngleToEncoder(int value, int unitsRev);
int servo360_unitsEncoderToAngle(int value, int unitsRev);
int servo360_findServoIndex(int pin);
void servo360_monitorRun(void);
void servo360_monitorEnd(void);
#endif
