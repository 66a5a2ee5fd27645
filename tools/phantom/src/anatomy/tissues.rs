//! What tissues look like to the scanner, in an arterial contrast phase.

use crate::shape::Tissue;

pub const AIR: Tissue = Tissue::plain(-990.0);
pub const LUNG: Tissue = Tissue::grained(-860.0, 35.0, 9.0);
pub const FAT: Tissue = Tissue::grained(-102.0, 12.0, 14.0);
pub const BOWEL_FLUID: Tissue = Tissue::grained(18.0, 12.0, 9.0);
pub const STOOL: Tissue = Tissue::grained(10.0, 90.0, 5.0);
pub const WATER: Tissue = Tissue::plain(8.0);
pub const SKIN: Tissue = Tissue::plain(10.0);
pub const MUSCLE: Tissue = Tissue::grained(52.0, 30.0, 11.0);
pub const ORGAN_WALL: Tissue = Tissue::plain(60.0);
pub const BRAIN: Tissue = Tissue::grained(34.0, 14.0, 8.0);
pub const CORD: Tissue = Tissue::plain(38.0);
pub const DISC: Tissue = Tissue::plain(90.0);
pub const CARTILAGE: Tissue = Tissue::grained(110.0, 40.0, 5.0);
pub const VEIN: Tissue = Tissue::plain(95.0);
pub const LIVER: Tissue = Tissue::grained(88.0, 10.0, 16.0);
pub const SPLEEN: Tissue = Tissue::grained(125.0, 18.0, 8.0);
pub const KIDNEY_CORTEX: Tissue = Tissue::grained(190.0, 20.0, 8.0);
pub const KIDNEY_MEDULLA: Tissue = Tissue::plain(110.0);
pub const MYOCARDIUM: Tissue = Tissue::grained(110.0, 12.0, 12.0);
pub const RIGHT_HEART_BLOOD: Tissue = Tissue::plain(210.0);
pub const LUNG_VESSEL: Tissue = Tissue::plain(230.0);
pub const ARTERY: Tissue = Tissue::plain(390.0);
pub const MARROW: Tissue = Tissue::grained(-40.0, 40.0, 9.0);
pub const SPONGY_BONE: Tissue = Tissue::grained(260.0, 110.0, 4.0);
pub const FACE_BONE: Tissue = Tissue::grained(750.0, 150.0, 6.0);
pub const CORTEX: Tissue = Tissue::grained(1150.0, 120.0, 10.0);
pub const SHAFT_CORTEX: Tissue = Tissue::grained(1450.0, 100.0, 12.0);
pub const TOOTH: Tissue = Tissue::plain(2000.0);
pub const FILLING: Tissue = Tissue::plain(3000.0);
pub const MARKER: Tissue = Tissue::plain(1700.0);
