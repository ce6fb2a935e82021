#!/bin/sh
# Starts scree from its archive. Where the system lacks libraries that GPU drivers use too (the C++ library, X11), those of
# lib/scree/fallback stand in; else the system's are used, which its drivers need.
self=$(readlink -f "$0" 2>/dev/null) || self=$0
home=${self%/*}/../lib/scree
case $(LD_TRACE_LOADED_OBJECTS=1 "$home/scree" 2>&1) in
*"not found"*)
    LD_LIBRARY_PATH=$home/fallback${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
    export LD_LIBRARY_PATH
    ;;
esac
exec "$home/scree" "$@"
