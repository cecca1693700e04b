#include "solver/model.h"
