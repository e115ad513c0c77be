#!/usr/bin/env bash
# vtkTemporalStatistics (ParaView: Temporal Statistics) is how a field's mean over time is made of a series, such as the
# time-averaged wall shear stress. It adds the values of all steps and divides by their number, whatever the times are. Where
# output is not equally spaced in time, fine in systole for one, that is no mean over time; and of a whole period both ends
# count, which are the same moment. The standard deviation is likewise.
# A guess would be the integral over time divided by the length of time: the filter has the times, and asks for each of them.
# Seen with VTK 9.1.0 (Debian 12): values 0, 10, 100 at times 0, 1, 10, of which the mean over time is 50.
# Output seen: 36.6667; and of 0, 1, 0, 1, 0 at equal times 0.4, of which the mean over time is 0.5.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
cat >"$scratch/12/root/mean.py" <<'END'
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkFiltersGeneral import vtkTemporalStatistics


class Series(VTKPythonAlgorithmBase):
    """A point with a value that changes in time."""

    def __init__(self, times, values):
        super().__init__(nInputPorts=0, outputType="vtkPolyData")
        self.times, self.values = times, values

    def RequestInformation(self, request, inputs, outputs):
        information = outputs.GetInformationObject(0)
        information.Set(Pipeline.TIME_STEPS(), self.times, len(self.times))
        information.Set(Pipeline.TIME_RANGE(), (self.times[0], self.times[-1]), 2)
        return 1

    def RequestData(self, request, inputs, outputs):
        time = outputs.GetInformationObject(0).Get(Pipeline.UPDATE_TIME_STEP())
        points, field = vtkPoints(), vtkDoubleArray()
        points.InsertNextPoint(0, 0, 0)
        field.SetName("wss")
        field.InsertNextValue(self.values[self.times.index(time)])
        data = vtkPolyData.GetData(outputs)
        data.SetPoints(points)
        data.GetPointData().AddArray(field)
        data.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), time)
        return 1


for times, values in (((0.0, 1.0, 10.0), (0.0, 10.0, 100.0)), ((0.0, 1.0, 2.0, 3.0, 4.0), (0.0, 1.0, 0.0, 1.0, 0.0))):
    statistics = vtkTemporalStatistics()
    series = Series(times, values)
    statistics.SetInputConnection(series.GetOutputPort())
    statistics.Update()
    mean = statistics.GetOutputDataObject(0).GetPointData().GetArray("wss_average").GetValue(0)
    over_time = sum((b - a) * (u + v) / 2 for a, b, u, v in zip(times, times[1:], values, values[1:])) / (times[-1] - times[0])
    print(f"average {mean:.6g}, mean over time {over_time:.6g}")
END
within "$scratch/12" python3 /root/mean.py >"$scratch/said" 2>"$scratch/log" || fail "python ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "the average"
average 36.6667, mean over time 50
average 0.4, mean over time 0.5
END
