//! The outputs of curvatures, and which method has which; for tests and fuzz targets.

use umbilic::capi::*;

/// The outputs, in the header's order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Out {
    K1,
    K2,
    Direction1,
    Direction2,
    Mean,
    Gaussian,
    MeanNormal,
    Area,
    IntegratedMean,
    IntegratedGaussian,
    ShapeIndex,
    Curvedness,
    Residual,
    Condition,
    DegreesOfFreedom,
    Normal,
}
use Out::*;

pub const OUTPUTS: [Out; 16] = [
    K1,
    K2,
    Direction1,
    Direction2,
    Mean,
    Gaussian,
    MeanNormal,
    Area,
    IntegratedMean,
    IntegratedGaussian,
    ShapeIndex,
    Curvedness,
    Residual,
    Condition,
    DegreesOfFreedom,
    Normal,
];

impl Out {
    pub fn components(self) -> usize {
        if matches!(self, Direction1 | Direction2 | MeanNormal | Normal) { 3 } else { 1 }
    }

    pub fn field(self, outputs: &mut umb_curvature_outputs) -> &mut umb_output {
        match self {
            K1 => &mut outputs.k1,
            K2 => &mut outputs.k2,
            Direction1 => &mut outputs.direction1,
            Direction2 => &mut outputs.direction2,
            Mean => &mut outputs.mean,
            Gaussian => &mut outputs.gaussian,
            MeanNormal => &mut outputs.mean_normal,
            Area => &mut outputs.area,
            IntegratedMean => &mut outputs.integrated_mean,
            IntegratedGaussian => &mut outputs.integrated_gaussian,
            ShapeIndex => &mut outputs.shape_index,
            Curvedness => &mut outputs.curvedness,
            Residual => &mut outputs.residual,
            Condition => &mut outputs.condition,
            DegreesOfFreedom => &mut outputs.degrees_of_freedom,
            Normal => &mut outputs.normal,
        }
    }

    /// The header's table.
    pub fn is_of(self, method: umb_curvature_method) -> bool {
        let fit = [UMB_CURVATURE_JET, UMB_CURVATURE_QUADRIC, UMB_CURVATURE_GOLDFEATHER].contains(&method);
        let adaptive = method == UMB_CURVATURE_ADAPTIVE_JET;
        let defect = method == UMB_CURVATURE_ANGLE_DEFECT;
        let (meyer, cycle) = (method == UMB_CURVATURE_MEYER, method == UMB_CURVATURE_NORMAL_CYCLE);
        let corrected = method == UMB_CURVATURE_CORRECTED_MEASURE;
        match self {
            K1 | K2 | ShapeIndex | Curvedness | Mean | MeanNormal => !defect,
            Direction1 | Direction2 => !defect && !meyer && method != UMB_CURVATURE_WATANABE,
            Gaussian | Normal => true,
            Area => meyer || defect || cycle || corrected,
            IntegratedMean => meyer || cycle || corrected,
            IntegratedGaussian => meyer || defect || corrected,
            Residual => fit || adaptive || method == UMB_CURVATURE_LEAST_SQUARES,
            Condition => fit,
            DegreesOfFreedom => adaptive,
        }
    }
}
